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
constexpr int patient_restarts = 6;

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

// Whether the last factor may serve another step: the step before went the whole way, without a
// shift, and brought the state so near that a tangent a little out of date still gains decimals.
bool factor_serves(const NewtonResult& result) {
  if (result.iterations.empty()) return false;
  const NewtonIteration& last = result.iterations.back();
  return last.step_length == 1 && last.shift == 0 && last.residual < near_enough &&
         last.residual < gain_wanted * last.residual_before;
}

// One Newton solve: what its parts need to see of each other.
class Solve {
 public:
  Solve(const SaddleProblem& problem, SaddleSolver& solver, SaddleMatrix& matrix,
        const Constraints& constraints, const Eigen::VectorXd* targets, SaddleState& state,
        const NewtonOptions& options)
      : problem_(problem),
        solver_(solver),
        matrix_(matrix),
        constraints_(constraints),
        moving_(constraints),
        targets_(targets),
        state_(state),
        options_(options),
        timer_(options.timer != nullptr ? *options.timer : unused_) {}

  NewtonResult run(const std::function<void(const NewtonIteration&)>& watch);

 private:
  double measure(const SaddleForces& forces) const;
  bool volumes_hold(const SaddleForces& forces) const;
  bool reached() const;
  /// True when the iteration is over: converged, or no tangent at the start.
  bool look(int i);
  bool factorise();
  bool direction(SaddleStep& step);
  NewtonIteration move(const SaddleStep& step);
  double search(const SaddleStep& step, double before);
  bool accept(const SaddleForces& now, const SaddleStep& step, double start, double before) const;
  void give_up(NewtonStop stop, const std::string& reason);

  const SaddleProblem& problem_;
  SaddleSolver& solver_;
  SaddleMatrix& matrix_;
  const Constraints& constraints_;
  Constraints moving_;  // with the increments still to go
  const Eigen::VectorXd* targets_;
  SaddleState& state_;
  const NewtonOptions& options_;
  Timer unused_;
  Timer& timer_;
  NewtonResult result_;
  bool away_ = false;    // held components are not at their targets yet
  bool serves_ = false;  // the last factor serves this step too
  double shift_ = 0;
};

double Solve::measure(const SaddleForces& forces) const {
  Eigen::VectorXd free = forces.r;
  constraints_.project(free);
  return free.norm() / problem_.load_norm();
}

bool Solve::volumes_hold(const SaddleForces& forces) const {
  const long rows = forces.theta.size() / long(forces.element_count);
  for (long i = 0; i < forces.theta.size(); ++i) {
    const double bound = options_.volume_tolerance * problem_.volume_scale(int(i / rows));
    if (!(std::abs(forces.theta[i]) <= bound)) return false;
  }
  return true;
}

bool Solve::reached() const {
  const double tolerance =
      std::max(options_.tolerance, rounding_force(matrix_, state_.u) / problem_.load_norm());
  return !away_ && result_.residual <= tolerance && volumes_hold(result_.forces);
}

void Solve::give_up(NewtonStop stop, const std::string& reason) {
  result_.stop = stop;
  result_.reason = reason;
}

// The last step's trial has the forces already; a tangent is only made for a factorisation.
bool Solve::look(int i) {
  away_ = aim(moving_, targets_, state_.u);
  serves_ = options_.reuse_factor && !away_ && factor_serves(result_);
  result_.converged = i > 0 && reached();
  if (result_.converged || serves_) return result_.converged;
  Timer::Scope phase(timer_, "assembly");
  if (!problem_.tangent(state_, result_.forces, matrix_)) {
    give_up(NewtonStop::folded,
            message("element ", result_.forces.bad_element, " is folded at the start"));
    return true;
  }
  result_.residual = measure(result_.forces);
  result_.converged = i == 0 && reached();
  return result_.converged;
}

bool Solve::factorise() {
  Timer::Scope phase(timer_, "factorisation");
  const Factorisation factor = solver_.factorise(matrix_, moving_, !options_.hasty);
  shift_ = factor.shift;
  if (!factor.ok) {
    give_up(NewtonStop::indefinite,
            "the tangent stiffness is far from positive definite (unstable equilibrium)");
  } else if (shift_ > 0) {
    ++result_.indefinite;
  }
  return factor.ok;
}

bool Solve::direction(SaddleStep& step) {
  Timer::Scope phase(timer_, "solve");
  step = solver_.solve(matrix_, result_.forces.r, result_.forces.theta, volume_accuracy,
                       options_.hasty ? 1 : patient_restarts);
  if (step.solved || !options_.hasty) return true;
  give_up(NewtonStop::linear_solver,
          message(step.iterations, " iterations did not solve a linear system"));
  return false;
}

NewtonIteration Solve::move(const SaddleStep& step) {
  NewtonIteration record;
  Timer::Scope phase(timer_, "line search");
  record.residual_before = result_.residual;
  record.linear_iterations = step.iterations;
  record.step_length =
      search(step, away_ ? std::numeric_limits<double>::infinity() : result_.residual);
  record.shift = shift_;
  result_.residual = record.residual = measure(result_.forces);
  record.min_det_F = result_.forces.min_det_F;
  record.max_det_F = result_.forces.max_det_F;
  return record;
}

// Step length in (0, 1], 0 when none is acceptable. On success state and forces are the new ones.
double Solve::search(const SaddleStep& step, double before) {
  // Slope of the augmented energy with the new pressure at the old state: −δuᵀ K_κ δu for a free
  // step.
  const double start = -step.u.dot(matrix_.stiffness.multiply(step.u));
  const double least = options_.determinant_guard * std::min(1.0, result_.forces.min_det_F);
  for (double length = 1; length >= options_.min_step; length *= 0.5) {
    SaddleState trial{state_.u + length * step.u, state_.p + length * step.p};
    SaddleForces now = problem_.forces(trial, &matrix_.kappa);
    if (!now.valid || !(now.min_det_F > least)) continue;
    if (accept(now, step, start, before)) {
      state_ = std::move(trial);
      result_.forces = std::move(now);
      return length;
    }
  }
  return 0;
}

bool Solve::accept(const SaddleForces& now, const SaddleStep& step, double start,
                   double before) const {
  if (!now.r.allFinite()) return false;
  Eigen::VectorXd gradient = now.augmented;
  constraints_.project(gradient);
  const double slope = step.u.dot(gradient);
  return std::abs(slope) <= slope_kept * std::abs(start) || measure(now) < before;
}

NewtonResult Solve::run(const std::function<void(const NewtonIteration&)>& watch) {
  const int before = solver_.factorisations();
  for (int i = 0; i <= options_.max_iterations; ++i) {
    if (look(i)) break;
    if (i == options_.max_iterations) {
      give_up(NewtonStop::iteration_limit,
              message("no convergence in ", i, " iterations: residual ", result_.residual,
                      " of the load, bound ", options_.tolerance));
      break;
    }
    if (!serves_ && !factorise()) break;
    SaddleStep step;
    if (!direction(step)) break;
    const NewtonIteration record = move(step);
    result_.iterations.push_back(record);
    if (watch) watch(record);
    if (record.step_length == 0 && !serves_) {
      give_up(NewtonStop::no_step,
              message("no admissible step along the Newton direction: residual ", result_.residual,
                      " of the load, smallest det F ", result_.forces.min_det_F));
      break;
    }
  }
  result_.factorisations = solver_.factorisations() - before;
  return std::move(result_);
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
    case NewtonStop::linear_solver:
      return "linear_solver";
  }
  return "";
}

double rounding_force(const SaddleMatrix& matrix, const Eigen::VectorXd& u) {
  return 8 * std::numeric_limits<double>::epsilon() * matrix.diagonal.cwiseProduct(u).norm();
}

NewtonResult newton(const SaddleProblem& problem, SaddleSolver& solver, SaddleMatrix& matrix,
                    const Constraints& constraints, const Eigen::VectorXd* targets,
                    SaddleState& state, const NewtonOptions& options,
                    const std::function<void(const NewtonIteration&)>& watch) {
  return Solve(problem, solver, matrix, constraints, targets, state, options).run(watch);
}

}  // namespace breast
