// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/augmented_lagrangian.hpp"

#include <algorithm>
#include <cmath>

#include "solve/equilibrate.hpp"

namespace breast {

namespace {
constexpr double volume_tolerance = 1e-8;
}

/// A penalised equilibrium with the multipliers given.
class AugmentedLagrangian::System final : public TangentSystem {
 public:
  System(AugmentedLagrangian& owner, State& state, double tolerance)
      : TangentSystem(owner.problem_, owner.solver_, owner.matrix_, state),
        owner_(owner),
        tolerance_(tolerance) {}

  bool begin() { return look(); }

  Balance assess(const NewtonResult& so_far) override {
    Balance now;
    now.residual = now.merit = relative(state_, forces_, problem_.constraints_at(state_.x));
    now.converged =
        now.residual <= tolerance_ && problem_.volume_residual(forces_) <= volume_tolerance;
    if (!now.converged && int(so_far.iterations.size()) >= owner_.options_.most_iterations) {
      now.stop = NewtonStop::iteration_limit;
      now.reason = describe(now.stop);
    }
    return now;
  }

  NewtonDirection direction(const Balance&) override {
    if (!assemble()) return {NewtonStop::folded, describe(NewtonStop::folded)};
    if (!factorise(problem_.constraints_at(state_.x)).ok) {
      return {NewtonStop::indefinite, describe(NewtonStop::indefinite)};
    }
    NewtonDirection direction = solve(contact_volume_accuracy, gmres_restarts);
    if (!step_.u.allFinite()) {
      return {NewtonStop::indefinite, describe(NewtonStop::indefinite)};
    }
    return direction;
  }

  LineSearchRule rule(const NewtonResult&, const Balance& now,
                      const NewtonDirection& direction) const override {
    LineSearchRule rule;
    rule.merit = now.merit;
    rule.tolerance = tolerance_;
    rule.flat_suffices = true;
    rule.downhill_suffices = direction.shift > 0;
    rule.kinks = true;
    return rule;
  }

 private:
  /// Unbalanced force relative to the force of the plates.
  double relative(const State& state, const Forces& forces, const Constraints& held) const {
    double square = 0;
    for (std::size_t c = 0; c < owner_.candidates_.size(); ++c) {
      const double force = owner_.plate_->at(c, state.x).force;
      square += force * force;
    }
    return problem_.free_norm(held, forces) /
           std::max({std::sqrt(square), problem_.load_norm(), 1e-30});
  }

  Appraisal appraise(const State& state, const Forces& forces) const override {
    Eigen::VectorXd gradient = forces.augmented.size() > 0 ? forces.augmented : forces.r;
    const Constraints held = problem_.constraints_at(state.x);
    held.project(gradient);
    const double there = relative(state, forces, held);
    return {there, there, along(gradient)};
  }

  AugmentedLagrangian& owner_;
  double tolerance_;
};

AugmentedLagrangian::AugmentedLagrangian(const Problem& body, SaddleSolver& solver,
                                         std::vector<int> candidates,
                                         AugmentedLagrangianOptions options)
    : problem_(body),
      solver_(solver),
      matrix_(body.make_matrix()),
      candidates_(std::move(candidates)),
      options_(options),
      plate_(std::make_shared<PlateTerm>(candidates_)) {
  memory_.touching.assign(candidates_.size(), -1);
  memory_.multipliers.assign(candidates_.size(), 0);
  memory_.penalty = options.penalty;
  problem_.add(plate_);
}

// A node keeps to the plate that already presses on it.
void AugmentedLagrangian::set_terms() {
  plate_->set_penalty(memory_.penalty);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const bool pressed = memory_.multipliers[c] > 0 && memory_.touching[c] >= 0;
    plate_->entry(c).plate = pressed ? memory_.touching[c] : -1;
    plate_->entry(c).multiplier = memory_.multipliers[c];
  }
}

bool AugmentedLagrangian::equilibrate(State& state, double tolerance, ContactStep& step) {
  set_terms();
  System system(*this, state, tolerance);
  if (!system.begin()) {
    step.stop = system.refusal();
    step.failed_trial = state.x;
    return false;
  }
  const NewtonResult part = newton(system);
  step.append(part);
  step.forces = system.forces();
  if (!part.converged && step.failed_trial.size() == 0) step.failed_trial = system.refused();
  return part.converged;
}

double AugmentedLagrangian::update_multipliers(const State& state) {
  double worst = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const PlateForce at = plate_->at(c, state.x);
    worst = std::max(worst, at.force > 0 ? std::abs(at.gap.value) : -at.gap.value);
    memory_.multipliers[c] = at.force;
    memory_.touching[c] = static_cast<signed char>(at.force > 0 ? at.plate : -1);
  }
  return worst;
}

void AugmentedLagrangian::finish(const PlatePair& plates, const State& state,
                                 ContactStep& step) const {
  step.converged = true;
  step.contacts.resize(candidates_.size());
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    step.contacts[c].plate = memory_.touching[c];
    step.contacts[c].normal = memory_.multipliers[c];
  }
  step.pressed = pressed_nodes(plates, state, step.contacts);
  step.failed_trial.resize(0);
}

ContactStep AugmentedLagrangian::solve(const PlatePair& plates, State& state, double tolerance) {
  plate_->set_plates(plates);
  ContactStep step;
  double last_gap = 1e30;
  std::size_t first = 0;  // iterations to an equilibrium with the previous multipliers
  for (int update = 0; update < options_.most_updates; ++update) {
    // Early multipliers are inaccurate, so their equilibria need not be accurate.
    const double sharp = std::max(tolerance, update < 2 ? 1e-4 : 1e-6);
    if (!equilibrate(state, sharp, step)) return step;
    if (update == 0) first = step.iterations.size();
    const double gap = update_multipliers(state);
    if (gap <= options_.gap_tolerance) {
      if (!equilibrate(state, tolerance, step)) return step;
      step.worst_penetration = update_multipliers(state);
      if (step.worst_penetration <= 2 * options_.gap_tolerance) {
        step.corrections = int(step.iterations.size() - first);
        finish(plates, state, step);
        return step;
      }
    }
    if (gap > 0.25 * last_gap) memory_.penalty *= 3;
    last_gap = gap;
  }
  step.stop = NewtonStop::iteration_limit;
  step.reason = describe(step.stop);
  return step;
}

}  // namespace breast
