#include "contact/active_set.hpp"

#include <algorithm>
#include <cmath>

#include "contact/step_search.hpp"

namespace breast {

namespace {
Vec3 node_vector(const Eigen::VectorXd& field, int node) {
  return field.segment<3>(3 * node);
}
/// A node that changed sides this often within one step keeps touching until convergence.
constexpr int most_toggles = 3;
/// Iterations in which touching nodes may move freely onto the plate.
constexpr int free_moves = 8;
/// Pull, as a part of the scale times the tolerance, from which on a node is let go.
constexpr double least_pull = 0.1;
/// Friction's bounds follow the normal forces once the imbalance is this part of their lag.
constexpr double balance_to_follow = 0.1;
/// Iterations granted for each with an indefinite tangent: itself and one to settle.
constexpr int slip_allowance = 2;
/// A hasty solve is given up when the first step has to be shorter than this, or when after so many
/// iterations the imbalance is still this part of the first.
constexpr double hasty_first_step = 0.2, hasty_reduction = 0.5;
constexpr int hasty_iterations = 8;
}  // namespace

std::string describe(StepOutcome outcome) {
  switch (outcome) {
    case StepOutcome::converged:
      return "converged";
    case StepOutcome::too_many_iterations:
      return "no convergence within the iteration limit";
    case StepOutcome::folded:
      return "an element folds";
    case StepOutcome::singular:
      return "the tangent matrix cannot be factorised";
    case StepOutcome::no_descent:
      return "no step reduces the residual";
  }
  return "unknown";
}

/// Residual and constraint violation at a state with the present touching set.
struct ActiveSet::Sweep {
  double free_norm = 0, scale = 0;  ///< µN: unbalanced force; reaction or load it is compared with
  double worst_gap = 0;             ///< mm, |distance| over touching nodes
  double volume_residual = 0;
  Eigen::VectorXd free;      ///< residual without reactions and touching normals
  Eigen::VectorXd gradient;  ///< of the augmented energy, likewise
  double relative() const { return free_norm / scale; }
};

ActiveSet::ActiveSet(ContactBody& body, std::vector<int> candidates, ActiveSetOptions options)
    : body_(body),
      candidates_(std::move(candidates)),
      options_(options),
      toggles_(candidates_.size(), 0) {
  memory_.touching.assign(candidates_.size(), -1);
}

ActiveSet::Sweep ActiveSet::measure(const PlatePair& plates, const BodyState& state,
                                    const BodyForces& forces) const {
  Sweep sweep;
  sweep.free = forces.residual;
  sweep.gradient = forces.augmented.size() > 0 ? forces.augmented : forces.residual;
  body_.remove_held(sweep.free);
  body_.remove_held(sweep.gradient);
  double reaction = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (memory_.touching[c] < 0) continue;
    const Eigen::Index at = 3 * candidates_[c];
    const Gap gap = plates.plate(memory_.touching[c]).gap(node_vector(state.x, candidates_[c]));
    const Vec3 normal = gap.gradient;
    const double pushed = sweep.free.segment<3>(at).dot(normal);
    reaction += pushed * pushed;
    sweep.free.segment<3>(at) -= pushed * normal;
    sweep.gradient.segment<3>(at) -= sweep.gradient.segment<3>(at).dot(normal) * normal;
    if (options_.friction.present()) {
      const Vec3 rubbed =
          friction_at(plates, c, node_vector(state.x, candidates_[c]), normal).force;
      sweep.free.segment<3>(at) -= rubbed;
      sweep.gradient.segment<3>(at) -= rubbed;
    }
    sweep.worst_gap = std::max(sweep.worst_gap, std::abs(gap.value));
  }
  sweep.free_norm = sweep.free.norm();
  sweep.scale = std::max({std::sqrt(reaction), body_.load_norm(), 1e-30});
  sweep.volume_residual = forces.volume_residual;
  return sweep;
}

/// Touching nodes keep their anchor relative to the plate's level, free ones where they are.
FrictionForce ActiveSet::friction_at(const PlatePair& plates, std::size_t candidate, const Vec3& x,
                                     const Vec3& normal) const {
  const Vec3 anchor =
      memory_.anchors[candidate] + plates.plate(memory_.touching[candidate]).shift();
  return options_.friction.at(x, anchor, normal, memory_.bounds[candidate]);
}

/// Where the state is balanced well enough for its normal forces to mean something, takes μλ for
/// the bounds. They do not follow in every iteration: then both could swing for ever.
bool ActiveSet::follow_bounds(const PlatePair& plates, const BodyState& state,
                              const BodyForces& forces, const Sweep& now) {
  std::vector<double> wanted = normal_forces(plates, state, forces);
  double lag = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    wanted[c] = options_.friction.bound(wanted[c]);
    if (memory_.touching[c] < 0) continue;
    lag = std::hypot(lag, wanted[c] - memory_.bounds[c]);
  }
  if (now.relative() > std::max(tolerance_, balance_to_follow * lag / now.scale)) return false;
  memory_.bounds = std::move(wanted);
  return true;
}

void ActiveSet::slide_anchors(const PlatePair& plates, const BodyState& state) {
  const std::vector<Vec3> rubbed = friction_forces(plates, state);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    memory_.anchors[c] = node_vector(state.x, candidates_[c]);
    if (memory_.touching[c] < 0) continue;
    // The part across the plate does not matter.
    memory_.anchors[c] +=
        rubbed[c] / options_.friction.stick - plates.plate(memory_.touching[c]).shift();
  }
}

bool ActiveSet::update(const PlatePair& plates, const BodyState& state, const BodyForces& forces,
                       double scale, bool may_drop, bool balanced) {
  bool changed = false;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const Vec3 x = node_vector(state.x, candidates_[c]);
    if (memory_.touching[c] < 0) {
      const int k = plates.nearer(x);
      if (plates.plate(k).gap(x).value < -options_.gap_tolerance) {
        memory_.touching[c] = static_cast<signed char>(k);
        // From now on the anchor moves with the plate.
        if (options_.friction.present()) memory_.anchors[c] -= plates.plate(k).shift();
        ++toggles_[c];
        changed = true;
      }
    } else if (may_drop && (balanced || toggles_[c] < most_toggles)) {
      const Gap gap = plates.plate(memory_.touching[c]).gap(x);
      const double pushed = node_vector(forces.residual, candidates_[c]).dot(gap.gradient);
      if (pushed < -least_pull * tolerance_ * scale) {
        if (options_.friction.present()) {
          memory_.anchors[c] += plates.plate(memory_.touching[c]).shift();
        }
        memory_.touching[c] = -1;
        changed = true;
      }
    }
  }
  return changed;
}

/// Positions too far from the last one show it in the first iterations.
bool ActiveSet::begins_badly(const StepResult& result, double first_imbalance) {
  if (result.iterations == 1) return result.history.back().step_length < hasty_first_step;
  return result.iterations == hasty_iterations &&
         result.residual > hasty_reduction * first_imbalance;
}

StepResult ActiveSet::solve(const PlatePair& plates, BodyState& state, double tolerance) {
  tolerance_ = tolerance;
  StepResult result;
  std::fill(toggles_.begin(), toggles_.end(), 0);
  if (options_.friction.present() && memory_.anchors.empty()) {
    for (const int node : candidates_) memory_.anchors.push_back(node_vector(state.x, node));
    memory_.bounds.assign(candidates_.size(), 0);
  }
  if (!body_.forces(state, result.forces)) {
    result.outcome = StepOutcome::folded;
    result.failed_trial = state.x;
    return result;
  }
  double first_imbalance = 0;
  for (;; ++result.iterations) {
    const auto balanced = [&](const Sweep& sweep) {
      return sweep.relative() <= tolerance_ &&
             sweep.worst_gap <= std::max(options_.gap_tolerance, tolerance_) &&
             sweep.volume_residual <= std::max(options_.volume_tolerance, tolerance_);
    };
    Sweep now = measure(plates, state, result.forces);
    if (options_.friction.present() && follow_bounds(plates, state, result.forces, now)) {
      now = measure(plates, state, result.forces);
    }
    const bool converged = balanced(now);
    // The multipliers of a state far from balance are noise: pulling nodes are dropped after the
    // first linearised solve, and later only from a converged state.
    const bool may_drop =
        converged || (result.iterations > 0 && result.iterations < options_.free_sweeps);
    const bool changed = update(plates, state, result.forces, now.scale, may_drop, converged);
    if (changed) now = measure(plates, state, result.forces);
    result.residual = now.relative();
    if (converged && !changed) break;
    // A step much too long is noticed early: the imbalance grows and stays. In a slip it may.
    if (result.iterations == 1) first_imbalance = now.relative();
    const bool hopeless = result.shifted == 0 && result.iterations >= 6 &&
                          now.relative() > 4 * first_imbalance && now.relative() > 0.1;
    result.hurried = hasty_ && begins_badly(result, first_imbalance);
    // A slip ends far from where it began: its iterations do not count against the limit.
    const int allowed = std::min(options_.max_iterations + slip_allowance * result.shifted,
                                 options_.most_iterations);
    if (result.iterations >= allowed || hopeless || result.hurried) {
      result.outcome = StepOutcome::too_many_iterations;
      return result;
    }
    if (!newton_step(plates, now, state, result)) return result;
  }
  if (options_.friction.present()) slide_anchors(plates, state);
  for (const int node : candidates_) {
    const Vec3 x = node_vector(state.x, node);
    const double distance = plates.plate(plates.nearer(x)).gap(x).value;
    result.worst_penetration = std::max(result.worst_penetration, -distance);
  }
  return result;
}

bool ActiveSet::newton_step(const PlatePair& plates, const Sweep& now, BodyState& state,
                            StepResult& result) {
  if (!body_.assemble(state)) {
    result.outcome = StepOutcome::folded;
    result.failed_trial = state.x;
    return false;
  }
  std::vector<NormalConstraint> constraints;
  Eigen::VectorXd unbalanced = result.forces.residual;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (memory_.touching[c] < 0) continue;
    const int node = candidates_[c];
    const Gap gap = plates.plate(memory_.touching[c]).gap(node_vector(state.x, node));
    const Vec3 normal = gap.gradient;
    constraints.push_back({node, normal, -gap.value});
    // A node sliding on a rounded edge turns its plate force; without this term Newton loses its
    // quadratic convergence and plate steps collapse.
    const double multiplier = node_vector(result.forces.residual, node).dot(normal);
    if (multiplier > 0 && !gap.hessian.isZero()) {
      body_.add_to_tangent(node, -multiplier * gap.hessian);
    }
    if (options_.friction.present()) {
      const FrictionForce rubbed = friction_at(plates, c, node_vector(state.x, node), normal);
      unbalanced.segment<3>(3 * node) -= rubbed.force;
      body_.add_to_tangent(node, rubbed.stiffness);
    }
  }
  BodyState increment;
  const BodySolve solve = body_.solve(constraints, unbalanced, increment);
  if (solve.shifted) ++result.shifted;
  if (!solve.ok || !increment.x.allFinite() || !increment.p.allFinite()) {
    result.outcome = StepOutcome::singular;
    return false;
  }
  return line_search(plates, now, increment, solve, state, result);
}

bool ActiveSet::line_search(const PlatePair& plates, const Sweep& now, const BodyState& increment,
                            const BodySolve& solve, BodyState& state, StepResult& result) {
  const auto merit = [](const Sweep& sweep) { return sweep.relative() + sweep.worst_gap; };
  const bool early = result.iterations < free_moves;
  // While nodes are being brought onto the plate the balance is bound to get worse: any admissible
  // step is then taken. Where the edge becomes straight that can alternate for ever; later
  // iterations must therefore reduce imbalance and gap together. A slipping node offers no
  // resistance until it turns back, where friction has another sign: with friction no step goes
  // beyond the place where the slope has turned that much.
  const bool rubs = options_.friction.present();
  StepRule rule;
  rule.merit = merit(now);
  rule.tolerance = tolerance_;
  rule.any = !rubs && now.worst_gap > 1e-3 && early;
  rule.flat_suffices = rubs || early;
  const auto appraise = [&](const BodyState& at, const BodyForces& forces) -> Appraisal {
    const Sweep sweep = measure(plates, at, forces);
    return {sweep.relative(), merit(sweep), increment.x.dot(sweep.gradient)};
  };
  return search_step(body_, increment, solve, rule, appraise, state, result);
}

std::vector<double> ActiveSet::normal_forces(const PlatePair& plates, const BodyState& state,
                                             const BodyForces& forces) const {
  std::vector<double> pushed(candidates_.size(), 0);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (memory_.touching[c] < 0) continue;
    const int node = candidates_[c];
    const Gap gap = plates.plate(memory_.touching[c]).gap(node_vector(state.x, node));
    pushed[c] = node_vector(forces.residual, node).dot(gap.gradient);
  }
  return pushed;
}

std::vector<Vec3> ActiveSet::friction_forces(const PlatePair& plates,
                                             const BodyState& state) const {
  if (!options_.friction.present()) return {};
  std::vector<Vec3> rubbed(candidates_.size(), Vec3::Zero());
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (memory_.touching[c] < 0) continue;
    const Vec3 x = node_vector(state.x, candidates_[c]);
    const Vec3 normal = plates.plate(memory_.touching[c]).gap(x).gradient;
    rubbed[c] = friction_at(plates, c, x, normal).force;
  }
  return rubbed;
}

}  // namespace breast
