// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/active_set.hpp"

#include <algorithm>

#include "contact/solvers/active_set_system.hpp"

namespace breast {

ActiveSet::ActiveSet(const Problem& body, SaddleSolver& solver, std::vector<int> candidates,
                     ActiveSetOptions options)
    : problem_(body),
      solver_(solver),
      matrix_(body.make_matrix()),
      candidates_(std::move(candidates)),
      options_(options),
      plate_(std::make_shared<PlateTerm>(candidates_)) {
  memory_.touching.assign(candidates_.size(), -1);
  memory_.multipliers.assign(candidates_.size(), 0);
  problem_.add(plate_);
  if (!options.friction.present()) return;
  friction_ = std::make_shared<FrictionTerm>();
  problem_.add(friction_);
}

// Touching nodes keep their anchor relative to the level of the plate; free nodes are anchored at
// their position.
void ActiveSet::set_terms(const PlatePair& plates) {
  plates_ = plates;
  plate_->set_plates(plates);
  std::vector<FrictionEntry> held;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const int k = memory_.touching[c];
    plate_->entry(c).plate = k;
    plate_->entry(c).multiplier = k < 0 ? 0 : memory_.multipliers[c];
    if (friction_ == nullptr || k < 0) continue;
    held.push_back({candidates_[c], k, memory_.anchors[c] + plates.plate(k).shift(),
                    memory_.bounds[c], options_.friction.stick(memory_.bounds[c])});
  }
  if (friction_ == nullptr) return;
  friction_->set_plates(plates);
  friction_->set_entries(std::move(held));
}

Constraints ActiveSet::constraints(const State& state) const {
  Constraints all = problem_.constraints_at(state.x);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (memory_.touching[c] < 0) continue;
    const int node = candidates_[c];
    const Gap gap = plates_.plate(memory_.touching[c]).gap(state.x.segment<3>(3L * node));
    all.hold_along(node, gap.gradient, -gap.value);
  }
  return all;
}

ContactStep ActiveSet::solve(const PlatePair& plates, State& state, double tolerance) {
  if (friction_ != nullptr && memory_.anchors.empty()) {
    for (const int node : candidates_) memory_.anchors.push_back(state.x.segment<3>(3L * node));
    memory_.bounds.assign(candidates_.size(), 0);
  }
  set_terms(plates);
  ContactStep step;
  System system(*this, state, tolerance);
  if (!system.begin()) {
    step.stop = system.refusal();
    step.failed_trial = state.x;
    return step;
  }
  static_cast<NewtonResult&>(step) = newton(system);
  step.hurried = system.hurried();
  if (step.converged) {
    step.contacts = system.finish();
  } else {
    step.failed_trial = system.refused();
  }
  step.forces = system.forces();
  for (const int node : candidates_) {
    const Vec3 x = state.x.segment<3>(3L * node);
    const double distance = plates.plate(plates.nearer(x)).gap(x).value;
    step.worst_penetration = std::max(step.worst_penetration, -distance);
  }
  return step;
}

}  // namespace breast
