// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss–Legendre points and weights on [-1,1], and their products on the square and the cube.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace breast {

/// Points in ascending order with their weights, exact for polynomials of degree 2n − 1; n = 2 or
/// 3.
struct GaussLine {
  std::vector<double> at, weight;
};
GaussLine gauss_line(int n);

/// Products with n² and n³ points; the first coordinate varies fastest.
struct GaussSquarePoint {
  Vec2 at;
  double weight;
};
std::vector<GaussSquarePoint> gauss_square(int n);

struct GaussCubePoint {
  Vec3 at;
  double weight;
};
std::vector<GaussCubePoint> gauss_cube(int n);

}  // namespace breast
