// Where a chain of meshes puts the material points whose true positions are known.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// A material point's true positions, mm LPS.
struct TrueLandmark {
  std::string name;
  Vec3 stress_free, prone, supine;
};

/// Rows of one side from a truth table (phantom --truth DIR writes it as landmarks.tsv: landmark,
/// side, {stress_free,prone,supine}_{x,y,z}_mm). Throws Error (input) beginning with `name`.
std::vector<TrueLandmark> true_landmarks(const Table& table, Side side, const std::string& name);

/// What a mesh file shows: "prone" (imaged), "stress_free" or "supine"; empty for anything else.
std::string posture_of(const HexMesh& mesh);

/// One row a landmark: the true point in the imaged frame is found in the first mesh (outside_mm:
/// how far it had to move to reach it), then compared with the truth in the posture of each mesh
/// (POSTURE_error_mm) beside the true displacement from prone (POSTURE_true_mm). All meshes must be
/// of one topology. The truth's own "tumour" is called "true-tumour". The nipple is also compared
/// as found from the image (prone_error_mm); of other points prone_error_mm is outside_mm, since
/// they are taken at their true prone place.
Table compare_with_truth(const std::vector<HexMesh>& meshes,
                         const std::vector<TrueLandmark>& truth);

}  // namespace breast
