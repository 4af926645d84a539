// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/inverse_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr int max_newton_iterations = 25;
// One factor is used until GMRES needs more iterations than this, because its back-substitutions
// then cost as much as a factorisation.
constexpr int factor_worn = 10, levels_worn = 45;
constexpr double of_volumes = 0.1;  // tolerance of volumes relative to that of forces
constexpr double near_tolerance = 1e-8, near_volume_tolerance = 1e-9;
// A volume error of this size counts as much as the whole load in the assessment of a step.
constexpr double typical_strain = 0.05;
constexpr double largest_growth = 20;  // of the largest det F in a step

}  // namespace

class InverseSolver::System final : public NewtonSystem {
 public:
  System(InverseSolver& owner, State& state, double tolerance)
      : owner_(owner), state_(state), tolerance_(tolerance) {}

  Balance assess(const NewtonResult& so_far) override;
  NewtonDirection direction(const Balance& now) override;
  LineSearchRule rule(const NewtonResult&, const Balance& now,
                      const NewtonDirection&) const override {
    LineSearchRule rule;
    rule.merit = now.merit;
    return rule;
  }
  std::optional<Trial> attempt(double length) override;
  void accept(Trial trial) override { state_ = std::move(trial.state); }
  int folded_element() const override { return owner_.problem_.folded_element(state_); }

 private:
  // Distance of a state from equilibrium.
  struct Distance {
    double force = 0, volume = 0;  // relative to the load; worst |θ_e|/V_e
    double merit = 0;
  };
  Distance distance(const Forces& forces) const;
  NewtonStop refusal() const override { return refusal_; }
  bool precondition();
  bool solve_direction(double accuracy);

  InverseSolver& owner_;
  State& state_;
  const double tolerance_;
  Forces forces_;
  ReferenceStep step_;
  NewtonStop refusal_ = NewtonStop::folded;
};

InverseSolver::System::Distance InverseSolver::System::distance(const Forces& forces) const {
  const Problem& problem = owner_.problem_;
  const PressureSpace& pressures = *problem.space().pressures;
  Distance out;
  out.force = problem.free_norm(problem.constraints_at(state_.x), forces) / problem.load_norm();
  out.volume = problem.volume_residual(forces);
  double square = 0;
  for (long i = 0; i < forces.theta.size(); ++i) {
    const double error = forces.theta[i] / pressures.volume(int(i / pressures.rows));
    square += error * error;
  }
  const double count = std::max(1.0, problem.sum(double(forces.theta.size())));
  square = problem.sum(square) / (count * typical_strain * typical_strain);
  out.merit = std::sqrt(out.force * out.force + square);
  return out;
}

Balance InverseSolver::System::assess(const NewtonResult& so_far) {
  {
    Timer::Scope phase(owner_.timer_, "assembly");
    Request request;
    request.reference = &owner_.tangent_;
    forces_ = owner_.problem_.evaluate(state_, request);
  }
  Balance now;
  if (!forces_.valid) {
    now.stop = NewtonStop::folded;
    now.reason = message("element ", forces_.bad_element, " is folded at the start");
    return now;
  }
  owner_.min_det_F_ = forces_.min_det_F;
  const Distance at = distance(forces_);
  const double bound =
      std::max(tolerance_, owner_.problem_.rounding_force(owner_.matrix_, state_.x) /
                               owner_.problem_.load_norm());
  now.residual = at.force;
  now.merit = at.merit;
  now.converged = at.force <= bound && at.volume <= of_volumes * tolerance_;
  now.nearly = at.force <= near_tolerance && at.volume <= near_volume_tolerance;
  if (!now.converged && int(so_far.iterations.size()) >= max_newton_iterations) {
    now.stop = NewtonStop::iteration_limit;
    now.reason = message("no convergence in ", max_newton_iterations, " iterations: residual ",
                         at.force, " of the load");
  }
  return now;
}

// Factorises the forward tangent at the state, for GMRES.
bool InverseSolver::System::precondition() {
  {
    Timer::Scope phase(owner_.timer_, "assembly");
    Forces forces;
    if (!owner_.problem_.tangent(state_, forces, owner_.matrix_)) return false;
  }
  Timer::Scope phase(owner_.timer_, "factorisation");
  owner_.last_gmres_ = 0;
  return owner_.solver_
      .factorise(owner_.matrix_, owner_.problem_.constraints_at(state_.x), !owner_.fail_fast_)
      .ok;
}

bool InverseSolver::System::solve_direction(double accuracy) {
  Timer::Scope phase(owner_.timer_, "solve");
  // The stress-free shape slides on the wall at its own position, not at that of the imaged shape.
  const Constraints moved = owner_.problem_.constraints_at(state_.reference);
  step_ = owner_.solve_reference_(owner_.matrix_, owner_.tangent_, moved, -forces_.r,
                                  -forces_.theta, accuracy, max_gmres);
  owner_.last_gmres_ = step_.iterations;
  // Newton's method converges with directions as rough as 0.5; where a direct solver can take over,
  // it does so earlier.
  return step_.residual < (owner_.fail_fast_ ? 0.1 : 0.5);
}

NewtonDirection InverseSolver::System::direction(const Balance& now) {
  const bool worn = owner_.last_gmres_ >
                    (owner_.solver_.kind() == LinearSolver::direct ? factor_worn : levels_worn);
  if (worn && !precondition()) {
    return {NewtonStop::singular_inverse, "the forward tangent cannot be factorised"};
  }
  const double accuracy = std::clamp(0.1 * now.merit, 1e-6, 1e-3);
  if (!solve_direction(accuracy) && (worn || !precondition() || !solve_direction(accuracy))) {
    return {NewtonStop::singular_inverse, "the inverse problem is singular"};
  }
  NewtonDirection direction;
  direction.linear_iterations = step_.iterations;
  return direction;
}

std::optional<Trial> InverseSolver::System::attempt(double length) {
  Timer::Scope phase(owner_.timer_, "line search");
  Trial trial;
  trial.state = {state_.reference + length * step_.x, state_.x, state_.p + length * step_.p};
  if (owner_.problem_.restore(trial.state.reference) >= 0) {
    refusal_ = NewtonStop::left_surface;
    return {};
  }
  refusal_ = NewtonStop::folded;
  trial.forces = owner_.problem_.forces(trial.state);
  const double most = largest_growth * std::max(1.0, forces_.max_det_F);
  if (!trial.forces.valid || !(trial.forces.max_det_F < most)) return {};
  const Distance there = distance(trial.forces);
  trial.seen = {there.force, there.merit, 0};
  return trial;
}

SolveReference solve_reference_by(const SaddleSolver& solver) {
  return [&solver](const SaddleMatrix& matrix, const ReferenceTangent& tangent,
                   const Constraints& moved, const Eigen::VectorXd& f, const Eigen::VectorXd& v,
                   double tolerance, int max_iterations) {
    const double size = std::cbrt(matrix.space->volume(0));
    return ReferenceSystem(matrix, tangent, solver, moved, size)
        .solve(f, v, tolerance, max_iterations);
  };
}

InverseSolver::InverseSolver(const Problem& problem, SaddleSolverBase& solver,
                             SolveReference solve_reference, bool fail_fast, Timer& timer)
    : problem_(problem),
      solver_(solver),
      solve_reference_(std::move(solve_reference)),
      fail_fast_(fail_fast),
      timer_(timer),
      matrix_(problem.make_matrix()) {}

NewtonResult InverseSolver::solve(State& state, double tolerance,
                                  const std::function<void(const NewtonIteration&)>& watch) {
  System system(*this, state, tolerance);
  return newton(system, watch);
}

bool InverseSolver::stable(const State& state, double augmentation) {
  Request request;
  request.matrix = &matrix_;
  request.augmentation = augmentation;
  const bool stable = problem_.evaluate(state, request).valid &&
                      solver_.factorise(matrix_, problem_.constraints_at(state.x), false).ok &&
                      solver_.positive_definite();
  // Without a factor there is no preconditioner.
  if (!stable || augmentation > 0) last_gmres_ = max_gmres;
  return stable;
}

}  // namespace breast
