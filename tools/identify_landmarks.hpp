// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of landmarks of two postures: one table, or marks of 3D Slicer in one or two files.
#pragma once

#include <filesystem>

#include "identification/landmark_pairs.hpp"

namespace breast {

/// Reads pairs from `first`, which is a table or a point list of 3D Slicer (.mrk.json, .fcsv). With the latter, the marks of the
/// second posture are those of `second`, or of `first` if `second` is empty. Marks are paired by
/// their labels without the words prone and supine ("prone-3" with "supine-3"); in a single file
/// without these words, the first mark of a label belongs to the scan. Throws Error (input) with
/// one line that names marks without a partner.
std::vector<LandmarkPair> read_landmark_pairs(const std::filesystem::path& first,
                                              const std::filesystem::path& second, Side side,
                                              double observer);

}  // namespace breast
