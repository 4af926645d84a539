// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/dead_load.hpp"

namespace breast {

Vec3 DeadLoad::total() const {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < force_.size(); i += 3) sum += force_.segment<3>(i);
  return sum;
}

bool DeadLoad::add(const State& state, const Request& request, Forces& forces) const {
  forces.r -= force_;
  if (request.kappa != nullptr) forces.augmented -= force_;
  forces.energy -= force_.dot(state.x - state.reference);
  return true;
}

std::vector<int> DeadLoad::nodes() const {
  std::vector<int> loaded;
  for (int node = 0; node < int(force_.size() / 3); ++node) {
    if (!force_.segment<3>(3L * node).isZero(0)) loaded.push_back(node);
  }
  return loaded;
}

}  // namespace breast
