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

/// Reads pairs from a table with columns prone_x_mm ... supine_z_mm and optionally landmark (its
/// name), observer_mm (default: `observer`) and side (rows of the other side are left out); the
/// phantom's landmarks.tsv is such a table. Throws Error (input) with a message that begins with
/// the table's name.
std::vector<LandmarkPair> landmark_pairs(const Table& table, Side side, double observer);

/// The pairs as observations of the mesh. Throws Error (input) with one line that names the
/// landmark, or the mistake that explains most of them: postures exchanged, RAS instead of LPS,
/// metres or centimetres, marks more than `outside` mm outside the body, motion that no breast
/// makes, names that occur twice, pairs of landmarks that contradict each other.
std::vector<SeenPoint> seen_points(const HexMesh& mesh, const std::vector<LandmarkPair>& pairs,
                                   double outside, const std::string& where);

}  // namespace breast
