// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/node_springs.hpp"

namespace breast {

bool NodeSprings::add(const State& state, const Request& request, Forces& forces) const {
  CellMatrices* reference =
      request.reference != nullptr ? &request.reference->next(cells_) : nullptr;
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  for (int i = 0; i < cells_.count(); ++i) {
    const int node = cells_.nodes[std::size_t(i)];
    const std::optional<Spring> now = spring(state, i);
    if (!now) return false;
    forces.r.segment<3>(3L * node) += now->force;
    if (request.kappa != nullptr) forces.augmented.segment<3>(3L * node) += now->force;
    forces.energy += now->energy;
    if (request.matrix != nullptr) {
      request.matrix->stiffness.add_to_node(node, now->tangent);
      request.matrix->diagonal.segment<3>(3L * node) += now->tangent.diagonal().cwiseAbs();
    }
    if (packed != nullptr) packed->set(i, now->tangent.data());
    if (reference != nullptr) Eigen::Map<Mat3>(reference->at(i)) = now->by_reference;
  }
  return true;
}

Eigen::VectorXd NodeSprings::forces(const State& state) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(state.x.size());
  for (int i = 0; i < cells_.count(); ++i) {
    if (const auto now = spring(state, i)) {
      out.segment<3>(3L * cells_.nodes[std::size_t(i)]) = now->force;
    }
  }
  return out;
}

Vec3 NodeSprings::force_on_body(const State& state) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < cells_.count(); ++i) {
    if (const auto now = spring(state, i)) sum -= now->force;
  }
  return sum;
}

}  // namespace breast
