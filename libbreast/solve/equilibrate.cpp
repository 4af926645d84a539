// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/equilibrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace {

// A factor is used again once the residual is this small and fell by this ratio in the last step.
constexpr double near_enough = 1e-5, gain_wanted = 0.02;
// Relative residual of the volume equation in a step. Forces are met exactly whatever it is, and
// volumes gain five digits per step in addition to Newton's convergence.
constexpr double volume_accuracy = 1e-5;
constexpr int halvings = 8;
// Sliding nodes farther from their wall after a step than this (mm) take the body with them, to this
// accuracy of the volumes.
constexpr double worth_following = 0.05, following_accuracy = 1e-2;

// Increments that move the components held by `fixed` to their targets, within all `constraints`.
bool aim(const Constraints& fixed, const Eigen::VectorXd* targets, const Eigen::VectorXd& x,
         Constraints& constraints) {
  if (targets == nullptr) return false;
  double most = 0;
  for (int node = 0; node < constraints.nodes(); ++node) {
    const NodeConstraint* held = fixed.at(node);
    if (held == nullptr) continue;
    NodeConstraint moved = *held;
    moved.increment =
        held->axes.transpose() * (targets->segment<3>(3L * node) - x.segment<3>(3L * node));
    for (int i = 0; i < 3; ++i) {
      if (held->held[i]) most = std::max(most, std::abs(moved.increment[i]));
    }
    constraints.set(node, moved);
  }
  return most > 1e-12 * std::max(1.0, x.lpNorm<Eigen::Infinity>());
}

// Whether the last factor may be used for another step: the previous step was a full one without a
// shift, and brought the state so close to equilibrium that a slightly outdated tangent still gains
// digits.
bool factor_serves(const NewtonResult& result) {
  if (result.iterations.empty()) return false;
  const NewtonIteration& last = result.iterations.back();
  return last.step_length == 1 && last.shift == 0 && last.residual < near_enough &&
         last.residual < gain_wanted * last.residual_before;
}

class EquilibriumSystem final : public TangentSystem {
 public:
  EquilibriumSystem(const Problem& problem, SaddleSolverBase& solver, SaddleMatrix& matrix,
                    State& state, const NewtonOptions& options, const Eigen::VectorXd* targets)
      : TangentSystem(problem, solver, matrix, state),
        options_(options),
        targets_(targets),
        moving_(problem.nodes()),
        timer_(options.timer != nullptr ? *options.timer : unused_) {}

  Balance assess(const NewtonResult& so_far) override;
  NewtonDirection direction(const Balance& now) override;
  LineSearchRule rule(const NewtonResult& so_far, const Balance& now,
                      const NewtonDirection& direction) const override;
  std::optional<Trial> attempt(double length) override {
    Timer::Scope phase(timer_, "line search");
    return TangentSystem::attempt(length);
  }

 private:
  Appraisal appraise(const State& state, const Forces& forces) const override;
  double residual(const Constraints& held, const Forces& forces) const {
    return problem_.free_norm(held, forces) / problem_.load_norm();
  }
  bool reached(double residual) const;

  const NewtonOptions& options_;
  const Eigen::VectorXd* targets_;
  Constraints moving_;  // with the increments still to go
  Timer unused_;
  Timer& timer_;
  bool away_ = false;    // whether held components are not yet at their targets
  bool serves_ = false;  // whether the last factor is used for this step too
};

bool EquilibriumSystem::reached(double residual) const {
  const double tolerance = std::max(
      options_.tolerance, problem_.rounding_force(matrix_, state_.x) / problem_.load_norm());
  return !away_ && residual <= tolerance &&
         problem_.volume_residual(forces_) <= options_.volume_tolerance;
}

// The trial of the last step already has the forces; a tangent is only computed for a
// factorisation.
Balance EquilibriumSystem::assess(const NewtonResult& so_far) {
  const int made = int(so_far.iterations.size());
  if (made == 0 && !put_on_surface()) {
    Balance lost;
    lost.stop = refusal();
    lost.reason = describe(lost.stop);
    return lost;
  }
  moving_ = problem_.constraints_at(state_.x);
  moving_.zero_increments();
  away_ = aim(problem_.constraints(), targets_, state_.x, moving_);
  serves_ = options_.reuse_factor && !away_ && factor_serves(so_far);
  Balance now;
  now.residual = so_far.residual;
  now.converged = made > 0 && reached(now.residual);
  if (now.converged) return now;
  if (!serves_) {
    Timer::Scope phase(timer_, "assembly");
    if (!assemble()) {
      now.stop = NewtonStop::folded;
      now.reason = message("element ", forces_.bad_element, " is folded at the start");
      return now;
    }
    now.residual = residual(moving_, forces_);
    now.converged = made == 0 && reached(now.residual);
    if (now.converged) return now;
  }
  now.merit = away_ ? std::numeric_limits<double>::infinity() : now.residual;
  if (made >= options_.max_iterations) {
    now.stop = NewtonStop::iteration_limit;
    now.reason = message("no convergence in ", made, " iterations: residual ", now.residual,
                         " of the load, bound ", options_.tolerance);
  }
  return now;
}

NewtonDirection EquilibriumSystem::direction(const Balance&) {
  double shift = 0;
  if (!serves_) {
    Timer::Scope phase(timer_, "factorisation");
    const Factorisation factor = factorise(moving_, !options_.fail_fast);
    shift = factor.shift;
    if (!factor.ok) {
      return {NewtonStop::indefinite,
              "the tangent stiffness is far from positive definite (unstable equilibrium)"};
    }
  }
  Timer::Scope phase(timer_, "solve");
  NewtonDirection direction = solve(volume_accuracy, options_.fail_fast ? 1 : gmres_restarts);
  direction.shift = shift;
  direction.provisional = serves_;
  if (!step_.solved && options_.fail_fast) {
    direction.stop = NewtonStop::linear_solver;
    direction.reason = message(step_.iterations, " iterations did not solve a linear system");
  }
  return direction;
}

LineSearchRule EquilibriumSystem::rule(const NewtonResult&, const Balance& now,
                                       const NewtonDirection&) const {
  LineSearchRule rule;
  rule.merit = now.merit;
  rule.most_halvings = halvings;
  rule.flat_suffices = true;
  return rule;
}

Appraisal EquilibriumSystem::appraise(const State& state, const Forces& forces) const {
  const Constraints held = problem_.constraints_at(state.x);
  Eigen::VectorXd gradient = forces.augmented;
  held.project(gradient);
  const double relative = residual(held, forces);
  return {relative, relative, along(gradient)};
}

}  // namespace

TangentSystem::TangentSystem(const Problem& problem, SaddleSolverBase& solver, SaddleMatrix& matrix,
                             State& state)
    : problem_(problem), solver_(solver), matrix_(matrix), state_(state) {}

bool TangentSystem::put_on_surface() {
  if (problem_.restore(state_.x) < 0) return true;
  forces_.valid = false;
  refusal_ = NewtonStop::left_surface;
  return false;
}

bool TangentSystem::look() {
  if (!put_on_surface()) return false;
  refusal_ = NewtonStop::folded;
  forces_ = problem_.forces(state_, matrix_.kappa.size() > 0 ? &matrix_.kappa : nullptr);
  return forces_.valid;
}

bool TangentSystem::assemble() {
  return problem_.tangent(state_, forces_, matrix_);
}

Factorisation TangentSystem::factorise(const Constraints& constraints, bool may_shift) {
  const Factorisation factor = solver_.factorise(matrix_, constraints, may_shift);
  shift_ = factor.shift;
  return factor;
}

NewtonDirection TangentSystem::solve(double volume_accuracy, int restarts) {
  Eigen::VectorXd r = forces_.r;
  // A factor of an earlier state constrains sliding nodes along the normals of that state: the
  // force of the wall, which has rotated since, must not count as a force along the wall.
  if (problem_.sliding() != nullptr) problem_.constraints_at(state_.x).project(r);
  step_ = solver_.solve(matrix_, r, forces_.theta, volume_accuracy, restarts);
  NewtonDirection direction;
  // Of a shared body the matrix is in parts and the vector complete, so that the products add up.
  direction.slope = problem_.sum(step_.u.dot(matrix_.stiffness.multiply(step_.u)));
  direction.shift = shift_;
  direction.linear_iterations = step_.iterations;
  if (!problem_.all(step_.u.allFinite() && step_.p.allFinite())) {
    direction.stop = NewtonStop::linear_solver;
    direction.reason = describe(direction.stop);
  }
  return direction;
}

void TangentSystem::change(const std::vector<const Term*>& terms,
                           const std::function<void()>& what) {
  const auto of_terms = [&] {
    Forces part;
    part.r = part.augmented = Eigen::VectorXd::Zero(forces_.r.size());
    Request request;
    request.kappa = &matrix_.kappa;  // requests the augmented forces too
    for (const Term* term : terms) term->add(state_, request, part);
    return part;
  };
  const Forces before = of_terms();
  what();
  const Forces after = of_terms();
  forces_.r += after.r - before.r;
  if (forces_.augmented.size() > 0) forces_.augmented += after.augmented - before.augmented;
}

// A step along the tangents of a curved wall ends at a distance from the wall of its square divided
// by the radius, which is millimetres if the breast slides by centimetres. Moving only the wall's
// nodes back would strain their elements. The body therefore follows them with preserved volumes,
// in the norm of the tangent: a second-order correction (Nocedal and Wright, Numerical
// Optimization, section 15.6). Returns false if a node has left the surface.
bool TangentSystem::follow_surface(double length, State& trial) const {
  const SlidingNodes* sliding = problem_.sliding();
  if (problem_.all(sliding == nullptr)) return true;
  Eigen::VectorXd back = Eigen::VectorXd::Zero(trial.x.size());
  if (sliding != nullptr) back = sliding->way_back(trial.x, solver_.constraints());
  if (!problem_.all(back.size() > 0)) return false;
  if (problem_.most(back.lpNorm<Eigen::Infinity>()) > worth_following) {
    const Forces there = problem_.forces(trial);
    const double left = 1 - std::min(1.0, length);
    const Eigen::VectorXd theta = there.valid ? Eigen::VectorXd(there.theta - left * forces_.theta)
                                              : Eigen::VectorXd::Zero(forces_.theta.size());
    trial.x += solver_.correction(matrix_, back, theta, following_accuracy);
  }
  return problem_.restore(trial.x) < 0;
}

std::optional<Trial> TangentSystem::attempt(double length) {
  Trial trial;
  trial.state = {state_.reference, state_.x + length * step_.u,
                 state_.p + std::min(1.0, length) * step_.p};
  if (!follow_surface(length, trial.state)) {
    refusal_ = NewtonStop::left_surface;
    return {};
  }
  trial.forces = problem_.forces(trial.state, &matrix_.kappa);
  const double least = determinant_guard * std::min(1.0, forces_.min_det_F);
  if (!trial.forces.valid || !(trial.forces.min_det_F > least) ||
      !problem_.all(trial.forces.r.allFinite())) {
    refusal_ = NewtonStop::folded;
    if (refused_.size() == 0) refused_ = trial.state.x;
    return {};
  }
  trial.seen = appraise(trial.state, trial.forces);
  return trial;
}

void TangentSystem::accept(Trial trial) {
  state_ = std::move(trial.state);
  forces_ = std::move(trial.forces);
}

EquilibriumResult equilibrate(const Problem& problem, SaddleSolverBase& solver,
                              SaddleMatrix& matrix, State& state, const NewtonOptions& options,
                              const Eigen::VectorXd* targets,
                              const std::function<void(const NewtonIteration&)>& watch) {
  const int before = solver.factorisations();
  EquilibriumSystem system(problem, solver, matrix, state, options, targets);
  EquilibriumResult result{newton(system, watch), system.forces()};
  result.factorisations = solver.factorisations() - before;
  return result;
}

}  // namespace breast
