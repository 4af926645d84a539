#include "solve/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double slope_kept = 0.8;  // accept when the slope along the step fell below this part
// A factor is used again once the residual is this small and fell by this part in the last step.
constexpr double near_enough = 1e-5, gain_wanted = 0.02;
// Relative residual of the volume equation in a step. Forces are met exactly whatever it is, and
// volumes gain five digits a step beside Newton's own.
constexpr double volume_accuracy = 1e-5;

// One Newton solve: the pieces of the iteration that need to see each other.
class Iteration {
 public:
  Iteration(const SaddleProblem& problem, const Constraints& constraints,
            const NewtonOptions& options)
      : problem_(problem), constraints_(constraints), options_(options) {}

  double measure(const SaddleForces& forces) const {
    Eigen::VectorXd free = forces.r;
    constraints_.project(free);
    return free.norm() / problem_.load_norm();
  }

  bool volumes_hold(const SaddleForces& forces) const {
    const long rows = forces.theta.size() / long(elements(forces));
    for (long i = 0; i < forces.theta.size(); ++i) {
      const double bound = options_.volume_tolerance * problem_.volume_scale(int(i / rows));
      if (!(std::abs(forces.theta[i]) <= bound)) return false;
    }
    return true;
  }

  // Step length in (0, 1], 0 when none is acceptable. On success `state` and `forces` are the new
  // ones.
  double search(const SaddleMatrix& matrix, const SaddleStep& step, double before,
                SaddleState& state, SaddleForces& forces) const {
    // Slope of the augmented energy with the new pressure at the old state: −δuᵀ K_κ δu for a free
    // step.
    const double start = -step.u.dot(matrix.stiffness.multiply(step.u));
    const double least = options_.determinant_guard * std::min(1.0, forces.min_det_F);
    for (double length = 1; length >= options_.min_step; length *= 0.5) {
      SaddleState trial{state.u + length * step.u, state.p + length * step.p};
      SaddleForces now = problem_.forces(trial, &matrix.kappa);
      if (!now.valid || !(now.min_det_F > least)) continue;
      if (accept(now, step, start, before)) {
        state = std::move(trial);
        forces = std::move(now);
        return length;
      }
    }
    return 0;
  }

 private:
  static std::size_t elements(const SaddleForces& forces) {
    return std::size_t(forces.element_count);
  }

  bool accept(const SaddleForces& now, const SaddleStep& step, double start, double before) const {
    if (!now.r.allFinite()) return false;
    Eigen::VectorXd gradient = now.augmented;
    constraints_.project(gradient);
    const double slope = step.u.dot(gradient);
    return std::abs(slope) <= slope_kept * std::abs(start) || measure(now) < before;
  }

  const SaddleProblem& problem_;
  const Constraints& constraints_;
  const NewtonOptions& options_;
};

// Increments that carry held components to their targets.
bool aim(Constraints& constraints, const Eigen::VectorXd* targets, const Eigen::VectorXd& u) {
  constraints.zero_increments();
  if (targets == nullptr) return false;
  double most = 0;
  for (int node = 0; node < constraints.nodes(); ++node) {
    const NodeConstraint* held = constraints.at(node);
    if (held == nullptr) continue;
    NodeConstraint moved = *held;
    moved.increment =
        held->axes.transpose() * (targets->segment<3>(3L * node) - u.segment<3>(3L * node));
    for (int i = 0; i < 3; ++i) {
      if (held->held[i]) most = std::max(most, std::abs(moved.increment[i]));
    }
    constraints.set(node, moved);
  }
  return most > 1e-12 * std::max(1.0, u.lpNorm<Eigen::Infinity>());
}

}  // namespace

const char* stop_name(NewtonStop stop) {
  switch (stop) {
    case NewtonStop::none:
      return "";
    case NewtonStop::folded:
      return "folded_element";
    case NewtonStop::iteration_limit:
      return "iteration_limit";
    case NewtonStop::indefinite:
      return "indefinite_tangent";
    case NewtonStop::no_step:
      return "no_admissible_step";
  }
  return "";
}

double rounding_force(const SaddleMatrix& matrix, const Eigen::VectorXd& u) {
  return 8 * std::numeric_limits<double>::epsilon() * matrix.diagonal.cwiseProduct(u).norm();
}

namespace {

// Whether the last factor may serve another step: the step before went the whole way, without a
// shift, and brought the state so near that a tangent a little out of date still gains decimals.
bool factor_serves(const NewtonResult& result) {
  if (result.iterations.empty()) return false;
  const NewtonIteration& last = result.iterations.back();
  return last.step_length == 1 && last.shift == 0 && last.residual < near_enough &&
         last.residual < gain_wanted * last.residual_before;
}

}  // namespace

NewtonResult newton(const SaddleProblem& problem, SaddleSolver& solver, SaddleMatrix& matrix,
                    const Constraints& constraints, const Eigen::VectorXd* targets,
                    SaddleState& state, const NewtonOptions& options,
                    const std::function<void(const NewtonIteration&)>& watch) {
  NewtonResult result;
  Timer unused;
  Timer& timer = options.timer != nullptr ? *options.timer : unused;
  Constraints moving = constraints;
  const Iteration iteration(problem, constraints, options);
  const int before = solver.factorisations();
  double shift = 0;
  for (int i = 0; i <= options.max_iterations; ++i) {
    const bool away = aim(moving, targets, state.u);
    const bool serves = options.reuse_factor && !away && factor_serves(result);
    const auto reached = [&] {
      const double tolerance =
          std::max(options.tolerance, rounding_force(matrix, state.u) / problem.load_norm());
      return !away && result.residual <= tolerance && iteration.volumes_hold(result.forces);
    };
    // The last step's trial has the forces already; a tangent is only made for a factorisation.
    result.converged = i > 0 && reached();
    if (!result.converged && !serves) {
      Timer::Scope phase(timer, "assembly");
      if (!problem.tangent(state, result.forces, matrix)) {
        result.stop = NewtonStop::folded;
        result.reason = message("element ", result.forces.bad_element, " is folded at the start");
        break;
      }
      result.residual = iteration.measure(result.forces);
      result.converged = i == 0 && reached();
    }
    if (result.converged) break;
    if (i == options.max_iterations) {
      result.stop = NewtonStop::iteration_limit;
      result.reason = message("no convergence in ", i, " iterations: residual ", result.residual,
                              " of the load, bound ", options.tolerance);
      break;
    }
    if (!serves) {
      Timer::Scope phase(timer, "factorisation");
      const Factorisation factor = solver.factorise(matrix, moving);
      shift = factor.shift;
      if (!factor.ok) {
        result.stop = NewtonStop::indefinite;
        result.reason =
            "the tangent stiffness is far from positive definite (unstable equilibrium)";
        break;
      }
      if (shift > 0) ++result.indefinite;
    }
    SaddleStep step;
    {
      Timer::Scope phase(timer, "solve");
      step = solver.solve(matrix, result.forces.r, result.forces.theta, volume_accuracy);
    }
    NewtonIteration record;
    Timer::Scope phase(timer, "line search");
    record.residual_before = result.residual;
    record.step_length = iteration.search(
        matrix, step, away ? std::numeric_limits<double>::infinity() : result.residual, state,
        result.forces);
    record.shift = shift;
    result.residual = record.residual = iteration.measure(result.forces);
    record.min_det_F = result.forces.min_det_F;
    record.max_det_F = result.forces.max_det_F;
    result.iterations.push_back(record);
    if (watch) watch(record);
    if (record.step_length == 0 && !serves) {
      result.stop = NewtonStop::no_step;
      result.reason =
          message("no admissible step along the Newton direction: residual ", result.residual,
                  " of the load, smallest det F ", result.forces.min_det_F);
      break;
    }
  }
  result.factorisations = solver.factorisations() - before;
  return result;
}

}  // namespace breast
