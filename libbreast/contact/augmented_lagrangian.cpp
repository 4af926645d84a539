#include "contact/augmented_lagrangian.hpp"

#include <algorithm>
#include <cmath>

#include "contact/step_search.hpp"

namespace breast {

/// Nearer plate, its gap, and the force μN per unit gap gradient.
struct AugmentedLagrangian::Contact {
  int plate = 0;
  Gap gap;
  double force = 0;
};

struct AugmentedLagrangian::Balance {
  Eigen::VectorXd unbalanced;  ///< residual minus plate forces, zero where held
  Eigen::VectorXd gradient;    ///< of the augmented energy, likewise
  double scale = 1;
  double relative() const { return unbalanced.norm() / scale; }
};

AugmentedLagrangian::AugmentedLagrangian(ContactBody& body, std::vector<int> candidates,
                                         AugmentedLagrangianOptions options)
    : body_(body), candidates_(std::move(candidates)), options_(options) {
  memory_.touching.assign(candidates_.size(), -1);
  memory_.multipliers.assign(candidates_.size(), 0);
  memory_.penalty = options.penalty;
}

AugmentedLagrangian::Contact AugmentedLagrangian::contact(const PlatePair& plates,
                                                          const Eigen::VectorXd& x,
                                                          std::size_t candidate) const {
  const Vec3 point = x.segment<3>(3 * candidates_[candidate]);
  Contact contact;
  // A node keeps to the plate that already pushes it.
  contact.plate = memory_.multipliers[candidate] > 0 && memory_.touching[candidate] >= 0
                      ? memory_.touching[candidate]
                      : plates.nearer(point);
  contact.gap = plates.plate(contact.plate).gap(point);
  contact.force =
      std::max(0.0, memory_.multipliers[candidate] - memory_.penalty * contact.gap.value);
  return contact;
}

AugmentedLagrangian::Balance AugmentedLagrangian::balance(const PlatePair& plates,
                                                          const BodyState& state,
                                                          const BodyForces& forces) const {
  Balance balance;
  balance.unbalanced = forces.residual;
  balance.gradient = forces.augmented.size() > 0 ? forces.augmented : forces.residual;
  double pushed = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const Contact at = contact(plates, state.x, c);
    if (at.force > 0) {
      balance.unbalanced.segment<3>(3 * candidates_[c]) -= at.force * at.gap.gradient;
      balance.gradient.segment<3>(3 * candidates_[c]) -= at.force * at.gap.gradient;
      pushed += at.force * at.force;
    }
  }
  body_.remove_held(balance.unbalanced);
  body_.remove_held(balance.gradient);
  balance.scale = std::max({std::sqrt(pushed), body_.load_norm(), 1e-30});
  return balance;
}

bool AugmentedLagrangian::equilibrate(const PlatePair& plates, BodyState& state, double tolerance,
                                      StepResult& result) {
  for (int k = 0; k < options_.most_iterations; ++k) {
    const Balance now = balance(plates, state, result.forces);
    result.residual = now.relative();
    if (now.relative() <= tolerance && result.forces.volume_residual <= 1e-8) return true;
    if (!body_.assemble(state)) break;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const Contact at = contact(plates, state.x, c);
      if (!(at.force > 0)) continue;
      body_.add_to_tangent(candidates_[c],
                           memory_.penalty * at.gap.gradient * at.gap.gradient.transpose() -
                               at.force * at.gap.hessian);
    }
    BodyState increment;
    const BodySolve solve = body_.solve({}, now.unbalanced, increment);
    if (solve.shifted) ++result.shifted;
    if (!solve.ok || !increment.x.allFinite()) {
      result.outcome = StepOutcome::singular;
      return false;
    }
    ++result.iterations;
    StepRule rule;
    rule.merit = now.relative();
    rule.tolerance = tolerance;
    rule.kinks = true;
    const auto appraise = [&](const BodyState& trial, const BodyForces& forces) -> Appraisal {
      const Balance there = balance(plates, trial, forces);
      return {there.relative(), there.relative(), increment.x.dot(there.gradient)};
    };
    if (!search_step(body_, increment, solve, rule, appraise, state, result)) return false;
  }
  result.outcome = StepOutcome::too_many_iterations;
  return false;
}

double AugmentedLagrangian::update_multipliers(const PlatePair& plates, const BodyState& state) {
  double worst = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const Contact at = contact(plates, state.x, c);
    const double gap = at.gap.value;
    worst = std::max(worst, at.force > 0 ? std::abs(gap) : -gap);
    memory_.multipliers[c] = at.force;
    memory_.touching[c] = static_cast<signed char>(at.force > 0 ? at.plate : -1);
  }
  return worst;
}

StepResult AugmentedLagrangian::solve(const PlatePair& plates, BodyState& state, double tolerance) {
  StepResult result;
  if (!body_.forces(state, result.forces)) {
    result.outcome = StepOutcome::folded;
    result.failed_trial = state.x;
    return result;
  }
  double last_gap = 1e30;
  int first = 0;  // iterations to an equilibrium with the multipliers of before
  for (int update = 0; update < options_.most_updates; ++update) {
    // Early multipliers are rough; their equilibria need not be sharp.
    const double sharp = std::max(tolerance, update < 2 ? 1e-4 : 1e-6);
    if (!equilibrate(plates, state, sharp, result)) return result;
    if (update == 0) first = result.iterations;
    const double gap = update_multipliers(plates, state);
    if (gap <= options_.gap_tolerance) {
      if (!equilibrate(plates, state, tolerance, result)) return result;
      result.worst_penetration = update_multipliers(plates, state);
      if (result.worst_penetration <= 2 * options_.gap_tolerance) {
        result.corrections = result.iterations - first;
        return result;
      }
    }
    if (gap > 0.25 * last_gap) memory_.penalty *= 3;
    last_gap = gap;
  }
  result.outcome = StepOutcome::too_many_iterations;
  return result;
}

std::vector<double> AugmentedLagrangian::normal_forces(const PlatePair&, const BodyState&,
                                                       const BodyForces&) const {
  return memory_.multipliers;
}

}  // namespace breast
