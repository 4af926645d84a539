// How far the faces of a mesh lie from the smooth surface that they stand for.
#pragma once

#include "meshing/hull.hpp"

namespace breast {

/// mm, weighted by area; from 5 × 5 points of every face to the nearest point of the surface.
struct BoundaryDistance {
  double mean = 0, p95 = 0, max = 0;
};

/// `part` is skin, wall or cut; `nodes` holds the corner nodes' places, `mesh` (order 1 or 2) the
/// same corners first.
BoundaryDistance boundary_distance(const BodyMap& body, Hull part, const std::vector<Face>& faces,
                                   const PlacedNodes& nodes, const HexMesh& mesh);

}  // namespace breast
