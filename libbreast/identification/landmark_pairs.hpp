// SPDX-License-Identifier: GPL-3.0-or-later
// Landmarks marked in two postures, read from tables, with checks for common mistakes.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "identification/observations.hpp"

namespace breast {

/// One material point in the scan and in the second posture, mm LPS.
struct LandmarkPair {
  std::string name;
  Vec3 imaged{0, 0, 0}, second{0, 0, 0};
  double observer = 2.5;  ///< rms error of the mark in space, mm
};

/// Columns prone_x_mm ... supine_z_mm, perhaps landmark (its name), observer_mm (else `observer`) and side
/// (rows of the other are left out): the phantom's landmarks.tsv is such a table. Throws Error (input)
/// beginning with the table's name.
std::vector<LandmarkPair> landmark_pairs(const Table& table, Side side, double observer);

/// The pairs as observations of the mesh. Throws Error (input), one line naming the landmark or the
/// slip that explains most of them: postures exchanged, RAS instead of LPS, metres or centimetres, marks
/// outside the body by more than `outside` mm, moves no breast makes, names that appear twice, pairs of
/// landmarks that contradict each other.
std::vector<SeenPoint> seen_points(const HexMesh& mesh, const std::vector<LandmarkPair>& pairs,
                                   double outside, const std::string& where);

}  // namespace breast
