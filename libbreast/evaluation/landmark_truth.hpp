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
  std::optional<double> own_error;  ///< mm; of the truth's own discretisation
};

/// A material point's true positions by posture: "stress_free", "prone",
/// "supine", "cc", "mlo", "ml".
struct TrueLandmark {
  std::string name;
  std::map<std::string, TruePosition> at;
};

/// Rows of one side from a truth table (phantom --truth DIR writes it as landmarks.tsv: landmark,
/// side, {stress_free,prone,supine}_{x,y,z}_mm; truth-table adds {cc,mlo,ml}_{x,y,z}_mm and
/// POSTURE_own_error_mm). The table must have been read with its number of rows. Throws Error
/// (input) beginning with `name`.
std::vector<TrueLandmark> true_landmarks(const Table& table, Side side, const std::string& name);

/// The posture of a mesh: "prone" (imaged), "stress_free", "supine", or when compressed its view in
/// small letters; empty for anything else.
std::string posture_of(const HexMesh& mesh);

/// One row per landmark: the true point in the imaged frame is found in the first mesh (outside_mm:
/// how far it had to move to reach it), then compared with the truth in the posture of each mesh
/// (POSTURE_error_mm) beside the true displacement from prone (POSTURE_true_mm) and the truth's own
/// error where it is known (POSTURE_own_error_mm: errors below it are not claimed). All meshes must
/// be of one topology. The truth's own "tumour" is called "true-tumour". The nipple is also
/// compared as found from the image (prone_error_mm); of other points prone_error_mm is outside_mm,
/// since they are taken at their true prone place.
Table compare_with_truth(const std::vector<HexMesh>& meshes,
                         const std::vector<TrueLandmark>& truth);

}  // namespace breast
