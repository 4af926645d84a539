// SPDX-License-Identifier: GPL-3.0-or-later
// Transfer of tissue from hexahedra to the tetrahedra of the same body.
#pragma once

#include "mesh/hex_mesh.hpp"
#include "mesh/tet_mesh.hpp"

namespace breast {

/// Gives every tetrahedron the tissue of the hexahedron (in the shape `points`) that contains its
/// centroid, or of the nearest one.
void copy_tissue(const HexMesh& hexahedra, TetMesh& mesh);

}  // namespace breast
