// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of a mesh as triangles, for other solvers and meshing programs.
#pragma once

#include "mesh/hex_mesh.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// The closed boundary in the shape `points` with outward normals, two triangles per face (eight
/// for order 2); scalar "part": 0 skin, 1 cut, 2 chest wall. Nodes on the line between two parts
/// occur once in each, so that every point belongs to one part.
TriMesh boundary_surface(const HexMesh& mesh);

}  // namespace breast
