// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/part_equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

// The same steps as in solve/equilibrate.cpp, which gives the reasons.
constexpr double near_enough = 1e-5, gain_wanted = 0.02;
constexpr double volume_accuracy = 1e-5;
constexpr int halvings = 8, most_gmres = gmres_restarts * 60;
constexpr double worth_following = 0.05, following_accuracy = 1e-2;

bool levels_serve(const NewtonResult& result) {
  if (result.iterations.empty()) return false;
  const NewtonIteration& last = result.iterations.back();
  return last.step_length == 1 && last.residual < near_enough &&
         last.residual < gain_wanted * last.residual_before;
}

}  // namespace

PartEquilibrium::PartEquilibrium(const PartProblem& problem, PartSaddle& solver,
                                 SaddleMatrix& matrix, State& state, int max_iterations,
                                 Timer& timer)
    : problem_(problem),
      solver_(solver),
      matrix_(matrix),
      state_(state),
      max_iterations_(max_iterations),
      timer_(timer) {}

bool PartEquilibrium::reached(double residual) const {
  return residual <= std::max(part_equilibrium_tolerance, problem_.rounding(matrix_, state_.x)) &&
         problem_.volume_residual(forces_) <= part_volume_tolerance;
}

Balance PartEquilibrium::assess(const NewtonResult& so_far) {
  const int made = int(so_far.iterations.size());
  Balance now;
  if (made == 0 && !problem_.restore(state_.x)) {
    now.stop = NewtonStop::left_surface;
    now.reason = describe(now.stop);
    return now;
  }
  serves_ = levels_serve(so_far);
  now.residual = so_far.residual;
  now.converged = made > 0 && reached(now.residual);
  if (now.converged) return now;
  if (!serves_) {
    Timer::Scope phase(timer_, "assembly");
    Request request;
    request.matrix = &matrix_;
    forces_ = problem_.evaluate(state_, request);
    if (!forces_.valid) {
      now.stop = NewtonStop::folded;
      now.reason = message("element ", forces_.bad_element, " is folded at the start");
      return now;
    }
    now.residual = residual(problem_.constraints_at(state_.x), forces_);
    now.converged = made == 0 && reached(now.residual);
    if (now.converged) return now;
  }
  now.merit = now.residual;
  if (made >= max_iterations_) {
    now.stop = NewtonStop::iteration_limit;
    now.reason = message("no convergence in ", made, " iterations: residual ", now.residual,
                         " of the load, bound ", part_equilibrium_tolerance);
  }
  return now;
}

NewtonDirection PartEquilibrium::direction(const Balance&) {
  Constraints held = problem_.constraints_at(state_.x);
  held.zero_increments();
  if (!serves_) {
    Timer::Scope phase(timer_, "factorisation");
    if (!solver_.factorise(matrix_, held)) {
      return {NewtonStop::indefinite,
              "the tangent stiffness is far from positive definite (unstable equilibrium)"};
    }
  }
  Timer::Scope phase(timer_, "solve");
  Eigen::VectorXd r = forces_.r;
  held.project(r);
  step_ = solver_.solve(matrix_, r, forces_.theta, {}, volume_accuracy, most_gmres);
  NewtonDirection direction;
  direction.linear_iterations = step_.iterations;
  direction.provisional = serves_;
  if (!step_.solved) {
    direction.stop = NewtonStop::linear_solver;
    direction.reason = message(step_.iterations, " iterations did not solve a linear system");
    return direction;
  }
  // The matrix is distributed and the vectors are complete, so that the products add up.
  direction.slope = problem_.ranks().sum(step_.u.dot(matrix_.stiffness.multiply(step_.u)));
  return direction;
}

LineSearchRule PartEquilibrium::rule(const NewtonResult&, const Balance& now,
                                     const NewtonDirection&) const {
  LineSearchRule rule;
  rule.merit = now.merit;
  rule.most_halvings = halvings;
  rule.flat_suffices = true;
  return rule;
}

// See TangentSystem::follow_surface in solve/equilibrate.cpp.
bool PartEquilibrium::follow_surface(double length, State& trial) const {
  const Ranks& ranks = problem_.ranks();
  const SlidingNodes* sliding = problem_.own().sliding();
  if (ranks.all(sliding == nullptr)) return true;
  Eigen::VectorXd back = Eigen::VectorXd::Zero(trial.x.size());
  if (sliding != nullptr) back = sliding->way_back(trial.x, solver_.constraints());
  if (!ranks.all(back.size() > 0)) return false;
  if (ranks.most(back.lpNorm<Eigen::Infinity>()) > worth_following) {
    const Forces there = problem_.forces(trial);
    const double left = 1 - std::min(1.0, length);
    const Eigen::VectorXd theta = there.valid ? Eigen::VectorXd(there.theta - left * forces_.theta)
                                              : Eigen::VectorXd::Zero(forces_.theta.size());
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(trial.x.size());
    trial.x += solver_.solve(matrix_, none, theta, back, following_accuracy, most_gmres).u;
  }
  return problem_.restore(trial.x);
}

std::optional<Trial> PartEquilibrium::attempt(double length) {
  Timer::Scope phase(timer_, "line search");
  Trial trial;
  trial.state = {state_.reference, state_.x + length * step_.u,
                 state_.p + std::min(1.0, length) * step_.p};
  if (!follow_surface(length, trial.state)) {
    refusal_ = NewtonStop::left_surface;
    return {};
  }
  trial.forces = problem_.forces(trial.state, &matrix_.kappa);
  refusal_ = NewtonStop::folded;
  const double least = determinant_guard * std::min(1.0, forces_.min_det_F);
  if (!trial.forces.valid || !(trial.forces.min_det_F > least)) return {};
  const Constraints held = problem_.constraints_at(trial.state.x);
  const double relative = residual(held, trial.forces);
  if (!std::isfinite(relative)) return {};
  Eigen::VectorXd gradient = trial.forces.augmented;
  held.project(gradient);
  trial.seen = {relative, relative, problem_.dot(gradient, step_.u)};
  return trial;
}

void PartEquilibrium::accept(Trial trial) {
  state_ = std::move(trial.state);
  forces_ = std::move(trial.forces);
}

}  // namespace breast
