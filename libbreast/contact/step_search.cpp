#include "contact/step_search.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

/// Part of the slope along a step that may be left at its end.
constexpr double slope_kept = 0.8;
/// Longest multiple of a shifted step.
constexpr double longest_slip = 64;
/// Times a Newton step is shortened before it is given up.
constexpr int most_halvings = 6;
/// Times more that the slope says by how much, and the least part of a length it may say.
constexpr int most_by_slope = 3;
constexpr double least_part = 0.01;

/// A trial state with its forces.
struct Trial {
  BodyState state;
  BodyForces forces;
  Appraisal seen;
};

/// Along a direction of negative curvature a shifted step is far too short: it is doubled while the
/// slope stays as steep as promised.
double go_further(ContactBody& body, const BodyState& start, const BodyState& increment,
                  const BodySolve& solve, const Appraise& appraise, Trial& trial) {
  double alpha = 1;
  while (trial.seen.along < -slope_kept * solve.slope && alpha < longest_slip) {
    Trial further;
    further.state = {start.x + 2 * alpha * increment.x, start.p + increment.p};
    if (!body.forces(further.state, further.forces)) break;
    further.seen = appraise(further.state, further.forces);
    if (further.seen.along > slope_kept * solve.slope) break;
    alpha *= 2;
    trial = std::move(further);
  }
  return alpha;
}

bool accepted(const Appraisal& seen, const BodySolve& solve, const StepRule& rule) {
  if (rule.any || seen.merit < rule.merit || seen.imbalance < rule.tolerance) return true;
  // Along a step of an indefinite tangent (a node slipping over the plate edge) the imbalance may
  // have to grow: going down in energy is then enough.
  if (solve.shifted) return seen.along <= slope_kept * solve.slope;
  return rule.flat_suffices && std::abs(seen.along) <= slope_kept * std::abs(solve.slope);
}

/// The part of a length at which the slope would be zero if it were linear from the start to the
/// trial's.
double flat_part(const Trial& trial, const BodySolve& solve) {
  const double slope = std::abs(solve.slope);
  if (!(trial.seen.along > 0)) return 0.5;
  return std::clamp(slope / (slope + trial.seen.along), least_part, 0.5);
}

}  // namespace

bool search_step(ContactBody& body, const BodyState& increment, const BodySolve& solve,
                 const StepRule& rule, const Appraise& appraise, BodyState& state,
                 StepResult& result) {
  const BodyState start = state;
  double alpha = 1;
  bool any_admissible = false;
  double shorter = 0.5;
  // Where the tangent is indefinite the slope is anything but linear.
  const int most = most_halvings + (rule.kinks && !solve.shifted ? most_by_slope : 0);
  for (int i = 0; i <= most; ++i, alpha *= shorter) {
    Trial trial;
    shorter = 0.5;
    trial.state = {start.x + alpha * increment.x, start.p + alpha * increment.p};
    if (!body.forces(trial.state, trial.forces)) {
      if (result.failed_trial.size() == 0) result.failed_trial = trial.state.x;
      continue;
    }
    any_admissible = true;
    trial.seen = appraise(trial.state, trial.forces);
    if (i >= most_halvings) shorter = flat_part(trial, solve);
    if (!accepted(trial.seen, solve, rule)) continue;
    if (solve.shifted && alpha == 1) {
      alpha = go_further(body, start, increment, solve, appraise, trial);
    }
    state = std::move(trial.state);
    result.forces = std::move(trial.forces);
    result.history.push_back(
        {trial.seen.imbalance, result.forces.min_det_F, result.forces.max_det_F, alpha});
    return true;
  }
  result.outcome = any_admissible ? StepOutcome::no_descent : StepOutcome::folded;
  return false;
}

}  // namespace breast
