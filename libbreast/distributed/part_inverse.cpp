// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/part_inverse.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/inverse_system.hpp"

namespace breast {

namespace {

// The same steps as in mechanics/inverse_system.cpp, which gives the reasons.
constexpr int max_iterations = 25, max_gmres = 60, levels_worn = 45;
constexpr double near_tolerance = 1e-8, near_volume_tolerance = 1e-9;
constexpr double typical_strain = 0.05, largest_growth = 20;

}  // namespace

PartInverse::PartInverse(const PartProblem& problem, PartSaddle& solver, SaddleMatrix& matrix,
                         State& state, Timer& timer)
    : problem_(problem),
      solver_(solver),
      matrix_(matrix),
      state_(state),
      timer_(timer),
      last_gmres_(solver.factorisations() > 0 ? 0 : max_gmres) {}

PartInverse::Distance PartInverse::distance(const Forces& forces) const {
  const Ranks& ranks = problem_.ranks();
  const PressureSpace& pressures = problem_.pressures();
  Distance out;
  out.force = problem_.free_norm(problem_.constraints_at(state_.x), forces) / problem_.load_norm();
  out.volume = problem_.volume_residual(forces);
  double square = 0;
  for (long i = 0; i < forces.theta.size(); ++i) {
    const double error = forces.theta[i] / pressures.volume(int(i / pressures.rows));
    square += error * error;
  }
  square = ranks.sum(square) / double(std::max(1L, ranks.sum(long(forces.theta.size())))) /
           (typical_strain * typical_strain);
  out.merit = std::sqrt(out.force * out.force + square);
  return out;
}

Balance PartInverse::assess(const NewtonResult& so_far) {
  {
    Timer::Scope phase(timer_, "assembly");
    Request request;
    request.reference = &tangent_;
    forces_ = problem_.evaluate(state_, request);
  }
  Balance now;
  if (!forces_.valid) {
    now.stop = NewtonStop::folded;
    now.reason = message("element ", forces_.bad_element, " is folded at the start");
    return now;
  }
  const Distance at = distance(forces_);
  const double bound = std::max(inverse_tolerance, problem_.rounding(matrix_, state_.x));
  now.residual = at.force;
  now.merit = at.merit;
  now.converged = at.force <= bound && at.volume <= part_volume_tolerance;
  now.nearly = at.force <= near_tolerance && at.volume <= near_volume_tolerance;
  if (!now.converged && int(so_far.iterations.size()) >= max_iterations) {
    now.stop = NewtonStop::iteration_limit;
    now.reason = message("no convergence in ", max_iterations, " iterations: residual ", at.force,
                         " of the load");
  }
  return now;
}

bool PartInverse::precondition() {
  {
    Timer::Scope phase(timer_, "assembly");
    Request request;
    request.matrix = &matrix_;
    if (!problem_.evaluate(state_, request).valid) return false;
  }
  Timer::Scope phase(timer_, "factorisation");
  last_gmres_ = 0;
  return solver_.factorise(matrix_, problem_.constraints_at(state_.x));
}

// Acts on (w, q) with w = −δX as [−K_X −Bᵀ; −B_X cM], which is close to [K −Bᵀ; B cM]
// (mechanics/reference_system.hpp). κBᵀM⁻¹ times the volumes is added to the forces on both sides,
// which makes the matrix similar to the one from which the multigrid levels are built.
bool PartInverse::solve_direction(double accuracy) {
  Timer::Scope phase(timer_, "solve");
  const PressureSpace& space = *matrix_.space;
  const Constraints moved = problem_.constraints_at(state_.reference);
  const auto augment = [&](const Eigen::VectorXd& bottom) -> Eigen::VectorXd {
    return matrix_.divergence.apply_transpose(space.divide(bottom, matrix_.kappa));
  };
  const auto map = [&](const Eigen::VectorXd& u, const Eigen::VectorXd& q, Eigen::VectorXd& top,
                       Eigen::VectorXd& bottom) {
    Eigen::VectorXd w = u;
    moved.project(w);
    bottom = space.multiply(q, space.compliance) - tangent_.b_x.apply(w);
    top = augment(bottom) - tangent_.apply(w) - tangent_.b.apply_transpose(q);
  };
  Eigen::VectorXd top = augment(-forces_.theta);
  problem_.exchange().sum(top);
  top -= forces_.r;
  double residual = 0;
  step_ = solver_.solve_near(map, top, -forces_.theta, accuracy, max_gmres, residual);
  moved.project(step_.u);
  last_gmres_ = step_.iterations;
  return residual < 0.5;
}

NewtonDirection PartInverse::direction(const Balance& now) {
  const bool worn = last_gmres_ > levels_worn;
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

LineSearchRule PartInverse::rule(const NewtonResult&, const Balance& now,
                                 const NewtonDirection&) const {
  LineSearchRule rule;
  rule.merit = now.merit;
  return rule;
}

std::optional<Trial> PartInverse::attempt(double length) {
  Timer::Scope phase(timer_, "line search");
  Trial trial;
  trial.state = {state_.reference - length * step_.u, state_.x, state_.p + length * step_.p};
  refusal_ = NewtonStop::left_surface;
  if (!problem_.restore(trial.state.reference)) return {};
  refusal_ = NewtonStop::folded;
  trial.forces = problem_.forces(trial.state);
  const double most = largest_growth * std::max(1.0, forces_.max_det_F);
  if (!trial.forces.valid || !(trial.forces.max_det_F < most)) return {};
  const Distance there = distance(trial.forces);
  trial.seen = {there.force, there.merit, 0};
  return trial;
}

}  // namespace breast
