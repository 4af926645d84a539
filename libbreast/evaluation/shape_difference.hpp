// SPDX-License-Identifier: GPL-3.0-or-later
// Derivative of a shape with respect to a parameter that changes the mesh, such as the chest wall,
// by the difference of two other models of the same breast.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

struct ShapeDifference {
  std::vector<Vec3> per_node;  ///< (plus − minus) / (2 step) at the base's nodes, mm per unit
  double outside_mm = 0;       ///< largest distance of a node from the imaged shape of another
                               ///< model
};

/// Every node of `base` is a position in the MR scan (imaged); it is located in the imaged shapes
/// of `plus` and `minus`, which may have other meshes, and mapped to their points. Nodes outside
/// use the nearest position. Throws Error (input) when side or view differ or a node is more than
/// `bound` mm outside.
ShapeDifference shape_difference(const HexMesh& base, const HexMesh& plus, const HexMesh& minus,
                                 double step, double bound = 20);

}  // namespace breast
