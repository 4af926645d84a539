// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shape.hpp"

#include <array>

namespace breast {

namespace {

// Node positions on the lattice {-1,0,1}^3 in VTK_TRIQUADRATIC_HEXAHEDRON order: corners, edges
// (bottom, top, vertical), faces (-ξ,+ξ,-η,+η,-ζ,+ζ), centre. The first 8 serve order 1.
constexpr std::array<std::array<int, 3>, 27> hex_lattice = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
     {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
     {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}, {-1, 0, 0},
     {1, 0, 0},    {0, -1, 0},  {0, 1, 0},   {0, 0, -1},  {0, 0, 1},   {0, 0, 0}}};
constexpr std::array<std::array<int, 2>, 9> quad_lattice = {
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};

// One-dimensional Lagrange function of the node at `at` and its derivative.
struct Line {
  double value, slope;
};
Line line(int order, int at, double x) {
  if (order == 1) return {0.5 * (1 + at * x), 0.5 * at};
  if (at == 0) return {1 - x * x, -2 * x};
  return {0.5 * x * (x + at), x + 0.5 * at};
}

}  // namespace

HexShape hex_shape(int order, const Vec3& local) {
  const int n = order == 1 ? 8 : 27;
  HexShape shape{Eigen::VectorXd(n), Eigen::Matrix3Xd(3, n)};
  for (int a = 0; a < n; ++a) {
    const Line u = line(order, hex_lattice[a][0], local.x());
    const Line v = line(order, hex_lattice[a][1], local.y());
    const Line w = line(order, hex_lattice[a][2], local.z());
    shape.values[a] = u.value * v.value * w.value;
    shape.gradients(0, a) = u.slope * v.value * w.value;
    shape.gradients(1, a) = u.value * v.slope * w.value;
    shape.gradients(2, a) = u.value * v.value * w.slope;
  }
  return shape;
}

QuadShape quad_shape(int order, const Vec2& local) {
  const int n = order == 1 ? 4 : 9;
  QuadShape shape{Eigen::VectorXd(n), Eigen::Matrix2Xd(2, n)};
  for (int a = 0; a < n; ++a) {
    const Line u = line(order, quad_lattice[a][0], local.x());
    const Line v = line(order, quad_lattice[a][1], local.y());
    shape.values[a] = u.value * v.value;
    shape.gradients(0, a) = u.slope * v.value;
    shape.gradients(1, a) = u.value * v.slope;
  }
  return shape;
}

Vec3 hex_node_local(int, int node) {
  return {double(hex_lattice[node][0]), double(hex_lattice[node][1]), double(hex_lattice[node][2])};
}

}  // namespace breast
