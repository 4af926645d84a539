// SPDX-License-Identifier: GPL-3.0-or-later
// Compression of the membrane skin, and whether the mesh can resolve the wrinkles that would form.
#pragma once

#include "material/material_set.hpp"
#include "mechanics/skin_folds.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// A membrane on a soft half-space under a compressive resultant N wrinkles at wave numbers above
/// 2μ/|N|, so with wave lengths below π|N|/μ; μ: the shear modulus of the deformed tissue beneath, in its weakest
/// direction. Where that is at least two elements long the mesh itself can wrinkle, and whether it did is seen by its
/// folds; it cannot resolve shorter wrinkles, which do no harm.
struct SkinState {
  int faces = 0, compressed = 0, wrinkling = 0;      ///< counts
  double compressed_share = 0, wrinkling_share = 0;  ///< of the deformed skin area
  double least_resultant_N_per_m = 0;                ///< most negative principal resultant
  double longest_wrinkle_mm = 0;                     ///< largest π|N|/μ
  SkinFolds folds;
};

/// The state of the membrane of `mesh` in the deformed shape; all zero without a membrane. `pressure`: of plates on the
/// nodes, empty without plates; a face on which they press at all nodes lies flat and cannot wrinkle.
SkinState skin_state(const HexMesh& mesh, const MaterialSet& materials,
                     const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed,
                     const std::vector<double>& pressure = {});

}  // namespace breast
