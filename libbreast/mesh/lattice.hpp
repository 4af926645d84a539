// SPDX-License-Identifier: GPL-3.0-or-later
// The isoparametric map of one element in lattice order (ξ fastest), without memory allocation, for
// the inner loop of point location. Internal to mesh/.
#pragma once

#include <array>

#include "core/types.hpp"

namespace breast::lattice {

/// VTK node number of each lattice point, ξ fastest; 8 entries for order 1, 27 for order 2.
const int* vtk_nodes(int order);

/// Computes x(ξ) and J = ∂x/∂ξ of an element with its (order+1)^3 points in lattice order.
void evaluate(int order, const Vec3* points, const Vec3& local, Vec3& x, Mat3& jacobian);

/// The local point in the box [-1,1]^3 with the image nearest to `point`. `fixed` is a coordinate
/// that keeps its value in `start` (a face), or −1. Returns the squared distance.
double closest_in_element(int order, const Vec3* points, const Vec3& point, int fixed, Vec3 start,
                          Vec3& local);

}  // namespace breast::lattice
