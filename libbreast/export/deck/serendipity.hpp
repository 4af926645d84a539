// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion between 27-node elements and the 20-node (serendipity) elements of other programs.
#pragma once

#include <array>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Shape functions of the 20-node hexahedron (corners, then mid-edges, VTK order) at a local point.
/// Source: Zienkiewicz and Taylor, The Finite Element Method, quadratic serendipity family.
std::array<double, 20> serendipity_shape(const Vec3& local);

/// Sets face centres and element centres to the values of the 20-node elements there. `nodal` has
/// one entry per node of the 27-node mesh, of which those at corners and mid-edges are given.
void interpolate_centres(const HexTopology& mesh, std::vector<Vec3>& nodal);

/// The transpose: forces on face and element centres are distributed to corners and mid-edges with
/// the same virtual work.
void gather_centres(const HexTopology& mesh, std::vector<Vec3>& force);

}  // namespace breast
