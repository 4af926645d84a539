// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay tetrahedra inside a closed surface.
#pragma once

#include "mesh/tet_mesh.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Conforming tetrahedra with edges of about `edge` mm inside a closed surface with the scalar
/// "part" (boundary_surface); the lines where two parts meet are preserved as edges. Delaunay
/// refinement with protected features and sliver exudation (CGAL Mesh_3; Jamin et al., ACM Trans
/// Math Softw 41(4), 2015). The same surface gives the same mesh. All tissue is fat. Throws Error
/// (input) for an open surface or an invalid edge length, and Error (failed) if a tetrahedron is
/// flat.
TetMesh delaunay_tetrahedra(const TriMesh& surface, double edge);

}  // namespace breast
