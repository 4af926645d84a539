// SPDX-License-Identifier: GPL-3.0-or-later
// Gathering of the nodal values of one element or face.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// 3 × N: the values (3 per node in `nodal`) of N nodes.
template <int N>
Eigen::Matrix<double, 3, N> gather(const int* nodes, const Eigen::VectorXd& nodal) {
  Eigen::Matrix<double, 3, N> out;
  for (int a = 0; a < N; ++a) out.col(a) = nodal.segment<3>(3L * nodes[a]);
  return out;
}
template <int N>
Eigen::Matrix<double, 3, N> gather(const int* nodes, const std::vector<Vec3>& nodal) {
  Eigen::Matrix<double, 3, N> out;
  for (int a = 0; a < N; ++a) out.col(a) = nodal[nodes[a]];
  return out;
}

}  // namespace breast
