// SPDX-License-Identifier: GPL-3.0-or-later
// Lagrange shape functions of the 8- and 27-node hexahedron and the 4- and 9-node quadrilateral, VTK
// node order, local coordinates in [-1,1].
#pragma once

#include <Eigen/Core>

#include "core/types.hpp"

namespace breast {

/// `values` has n entries and `gradients` is 3 × n (rows d/dξ, d/dη, d/dζ), with n = 8 (order 1) or
/// 27 (order 2).
struct HexShape {
  Eigen::VectorXd values;
  Eigen::Matrix3Xd gradients;
};
HexShape hex_shape(int order, const Vec3& local);

/// `values` has n entries and `gradients` is 2 × n, with n = 4 (order 1) or 9 (order 2).
struct QuadShape {
  Eigen::VectorXd values;
  Eigen::Matrix2Xd gradients;
};
QuadShape quad_shape(int order, const Vec2& local);

/// Local coordinates of node `node` of the hexahedron of the given order.
Vec3 hex_node_local(int order, int node);

}  // namespace breast
