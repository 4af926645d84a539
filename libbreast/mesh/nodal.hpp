// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of nodal fields between meshes (one Vec3 per node) and solvers (3 numbers per node).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/types.hpp"

namespace breast {

inline Eigen::VectorXd flatten(const std::vector<Vec3>& nodal) {
  Eigen::VectorXd flat(3L * long(nodal.size()));
  for (std::size_t i = 0; i < nodal.size(); ++i) flat.segment<3>(3L * long(i)) = nodal[i];
  return flat;
}

inline std::vector<Vec3> unflatten(const Eigen::VectorXd& flat) {
  std::vector<Vec3> nodal(static_cast<std::size_t>(flat.size() / 3));
  for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = flat.segment<3>(3L * long(i));
  return nodal;
}

}  // namespace breast
