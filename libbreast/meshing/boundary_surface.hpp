// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of a mesh as triangles, for other solvers and meshing programs.
#pragma once

#include "mesh/hex_mesh.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// The closed boundary of `points`, two triangles per face (eight for order 2), turned outwards;
/// scalar "part": 0 skin, 1 cut, 2 chest wall. Nodes on the line between two parts occur once in
/// each, so that every point has one part.
TriMesh boundary_surface(const HexMesh& mesh);

}  // namespace breast
