// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/terms/plate.hpp"

#include <algorithm>

namespace breast {

PlateTerm::PlateTerm(std::vector<int> candidates) {
  for (const int node : candidates) entries_.push_back({node, -1, 0});
  cells_.nodes_per_cell = 1;
  cells_.nodes = std::move(candidates);
}

PlateForce PlateTerm::at(std::size_t candidate, const Eigen::VectorXd& x) const {
  const PlateEntry& entry = entries_[candidate];
  const Vec3 point = x.segment<3>(3L * entry.node);
  PlateForce out;
  out.plate = entry.plate >= 0 ? entry.plate : plates_.nearer(point);
  out.gap = plates_.plate(out.plate).gap(point);
  out.force = std::max(0.0, entry.multiplier - penalty_ * out.gap.value);
  return out;
}

bool PlateTerm::add(const State& state, const Request& request, Forces& forces) const {
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  for (std::size_t c = 0; c < entries_.size(); ++c) {
    const PlateEntry& entry = entries_[c];
    if (penalty_ == 0 && !(entry.multiplier > 0)) continue;
    const PlateForce now = at(c, state.x);
    forces.energy += penalty_ > 0 ? (now.force * now.force - entry.multiplier * entry.multiplier) /
                                        (2 * penalty_)
                                  : -entry.multiplier * now.gap.value;
    const double force = penalty_ > 0 ? now.force : entry.multiplier;
    if (!(force > 0)) continue;
    const long at = 3L * entry.node;
    forces.r.segment<3>(at) -= force * now.gap.gradient;
    if (request.kappa != nullptr) forces.augmented.segment<3>(at) -= force * now.gap.gradient;
    const Mat3 block =
        penalty_ * now.gap.gradient * now.gap.gradient.transpose() - force * now.gap.hessian;
    if (request.matrix != nullptr) request.matrix->stiffness.add_to_node(entry.node, block);
    if (packed != nullptr) packed->set(int(c), block.data());
  }
  return true;
}

std::vector<int> PlateTerm::nodes() const {
  std::vector<int> all = cells_.nodes;
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace breast
