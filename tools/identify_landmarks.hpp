// SPDX-License-Identifier: GPL-3.0-or-later
// Landmarks of two postures as users have them: one table, or marks of 3D Slicer in one file or two.
#pragma once

#include <filesystem>

#include "identification/landmark_pairs.hpp"

namespace breast {

/// Pairs of `first`: a table, or a .mrk.json; of .mrk.json the second posture's marks are those of `second`, or where that is empty
/// in the same file. Marks pair by their labels, whose words prone and supine are put aside ("prone-3" is "supine-3"); in one
/// file without these words the first mark of a label is the scan's. Throws Error (input), one line, naming marks
/// without a partner.
std::vector<LandmarkPair> read_landmark_pairs(const std::filesystem::path& first,
                                              const std::filesystem::path& second, Side side,
                                              double observer);

}  // namespace breast
