// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of the boundary faces of a mesh from the smooth surface that they approximate.
#pragma once

#include "core/distances.hpp"
#include "meshing/hull.hpp"

namespace breast {

/// Area-weighted distances from 5 × 5 points of every face to the nearest point of the surface.
/// `part` is skin, wall or cut; `nodes` contains the positions of the corner nodes, and `mesh`
/// (order 1 or 2) has the same corners first.
Distances boundary_distance(const BodyMap& body, Hull part, const std::vector<Face>& faces,
                            const PlacedNodes& nodes, const HexMesh& mesh);

}  // namespace breast
