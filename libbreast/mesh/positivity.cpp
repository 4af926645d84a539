// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/positivity.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "core/elementary.hpp"
#include "mesh/lattice.hpp"

namespace breast {

namespace {

constexpr int deepest = 4;

/// A polynomial in three variables by its values or coefficients, n along each, first fastest.
struct Cube {
  int n = 0;
  std::vector<double> value;
  double& at(int i, int j, int k) { return value[(std::size_t(k) * n + j) * n + i]; }
  double at(int i, int j, int k) const { return value[(std::size_t(k) * n + j) * n + i]; }
};

/// `matrix` applied along one direction.
Cube along(const Cube& cube, int axis, const Eigen::MatrixXd& matrix) {
  const int n = cube.n;
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? n : std::size_t(n) * n;
  Cube out = cube;
  for (std::size_t start = 0; start < cube.value.size(); ++start) {
    if (start / stride % n != 0) continue;
    for (int row = 0; row < n; ++row) {
      double sum = 0;
      for (int column = 0; column < n; ++column)
        sum += matrix(row, column) * cube.value[start + column * stride];
      out.value[start + row * stride] = sum;
    }
  }
  return out;
}

/// Values at n equally spaced points of [0,1] to Bernstein coefficients of degree n - 1.
Eigen::MatrixXd bernstein_from_values(int n) {
  Eigen::MatrixXd values(n, n);
  for (int row = 0; row < n; ++row) {
    const double t = double(row) / (n - 1);
    double binomial = 1;
    for (int column = 0; column < n; ++column) {
      values(row, column) =
          binomial * elementary::pow(t, column) * elementary::pow(1 - t, n - 1 - column);
      binomial *= double(n - 1 - column) / (column + 1);
    }
  }
  return values.inverse();
}

/// Coefficients on [0,1] to those on its first half (de Casteljau); its mirror gives the second.
Eigen::MatrixXd first_half(int n) {
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(n, n);
  for (int row = 0; row < n; ++row) {
    double binomial = 1;
    for (int column = 0; column <= row; ++column) {
      half(row, column) = binomial * std::ldexp(1.0, -row);
      binomial *= double(row - column) / (column + 1);
    }
  }
  return half;
}

Cube determinants(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element) {
  const int* vtk = lattice::vtk_nodes(mesh.order);
  std::array<Vec3, 27> own;
  for (int a = 0; a < mesh.nodes_per_element(); ++a) own[a] = nodal[mesh.element(element)[vtk[a]]];
  Cube cube;
  cube.n = mesh.order == 1 ? 3 : 6;
  cube.value.resize(std::size_t(cube.n) * cube.n * cube.n);
  const auto local = [&](int i) { return 2.0 * i / (cube.n - 1) - 1; };
  Vec3 x;
  Mat3 jacobian;
  for (int k = 0; k < cube.n; ++k) {
    for (int j = 0; j < cube.n; ++j) {
      for (int i = 0; i < cube.n; ++i) {
        lattice::evaluate(mesh.order, own.data(), Vec3(local(i), local(j), local(k)), x, jacobian);
        cube.at(i, j, k) = jacobian.determinant();
      }
    }
  }
  return cube;
}

double bound(const Cube& coefficients, int depth) {
  const int last = coefficients.n - 1;
  double taken = coefficients.at(0, 0, 0);
  for (int c = 1; c < 8; ++c)
    taken = std::min(taken, coefficients.at((c & 1) * last, (c >> 1 & 1) * last, (c >> 2) * last));
  if (!(taken > 0)) return taken;
  const double least = *std::min_element(coefficients.value.begin(), coefficients.value.end());
  if (least > 0 || depth == deepest) return least;
  const Eigen::MatrixXd half = first_half(coefficients.n);
  const Eigen::MatrixXd other = half.reverse();
  double lowest = taken;
  for (int part = 0; part < 8; ++part) {
    Cube cube = along(coefficients, 0, part & 1 ? other : half);
    cube = along(cube, 1, part & 2 ? other : half);
    lowest = std::min(lowest, bound(along(cube, 2, part & 4 ? other : half), depth + 1));
    if (!(lowest > 0)) break;
  }
  return lowest;
}

}  // namespace

double jacobian_lower_bound(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element) {
  static const std::array<Eigen::MatrixXd, 2> to_bernstein{bernstein_from_values(3),
                                                           bernstein_from_values(6)};
  Cube cube = determinants(mesh, nodal, element);
  for (int axis = 0; axis < 3; ++axis) cube = along(cube, axis, to_bernstein[mesh.order - 1]);
  return bound(cube, 0);
}

}  // namespace breast
