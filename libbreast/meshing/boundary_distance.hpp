// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of the boundary faces of a mesh from the smooth surface that they approximate.
#pragma once

#include "core/distances.hpp"
#include "meshing/hull.hpp"

namespace breast {

/// Weighted by area; from 5 × 5 points of every face to the nearest point of the surface.
/// `part` is skin, wall or cut; `nodes` holds the corner nodes' places, `mesh` (order 1 or 2) the
/// same corners first.
Distances boundary_distance(const BodyMap& body, Hull part, const std::vector<Face>& faces,
                            const PlacedNodes& nodes, const HexMesh& mesh);

}  // namespace breast
