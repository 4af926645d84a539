// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the landmarks of a chain of meshes against their known true positions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// True position of a material point in one posture, mm LPS, and its uncertainty.
struct TruePosition {
  Vec3 x{0, 0, 0};
  std::optional<double> own_error;  ///< own discretisation error of the truth, mm
};

/// A material point's true positions by posture: "stress_free", "prone",
/// "supine", "cc", "mlo", "ml".
struct TrueLandmark {
  std::string name;
  std::map<std::string, TruePosition> at;
};

/// Rows of one side from a truth table (phantom --truth DIR writes it as landmarks.tsv: landmark, side,
/// {stress_free,prone,supine}_{x,y,z}_mm; truth-table adds {cc,mlo,ml}_{x,y,z}_mm and POSTURE_own_error_mm).
/// The prone positions are required, the others are read where they are given. The table must have been read
/// with its number of rows. Throws Error (input) beginning with `name`.
std::vector<TrueLandmark> true_landmarks(const Table& table, Side side, const std::string& name);

/// The posture of a mesh: "prone" (imaged), "stress_free", "supine" or, if compressed, its view in
/// lower case; empty for anything else.
std::string posture_of(const HexMesh& mesh);

/// One row per landmark. The true point in the imaged frame is located in the first mesh
/// (outside_mm: the distance that it was moved to reach the mesh) and compared with the truth in
/// the posture of each mesh (POSTURE_error_mm), beside the true displacement from prone
/// (POSTURE_true_mm) and, if known, the truth's own error (POSTURE_own_error_mm), below which
/// errors have no meaning. All meshes must have the same topology. The truth's own "tumour" is
/// called "true-tumour". The nipple is also compared as found from the image (prone_error_mm). For
/// other points, which are taken at their true prone position, prone_error_mm is outside_mm.
Table compare_with_truth(const std::vector<HexMesh>& meshes,
                         const std::vector<TrueLandmark>& truth);

}  // namespace breast
