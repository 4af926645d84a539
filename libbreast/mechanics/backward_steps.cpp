// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/backward_steps.hpp"

#include "core/error.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

constexpr double rough_tolerance = 1e-2;

}  // namespace

BackwardSteps::BackwardSteps(LoadedProblem& loaded, SaddleSolverBase& solver,
                             SolveReference solve_reference, bool fail_fast, std::string name,
                             Equilibrium& found, Progress& progress)
    : loaded_(loaded),
      solver_(solver),
      fail_fast_(fail_fast),
      name_(std::move(name)),
      found_(found),
      log_(found, progress),
      inverse_(loaded.problem, solver, std::move(solve_reference), fail_fast, found.timer) {}

NewtonResult BackwardSteps::attempt(State& state, double from, double to, double tolerance) {
  NewtonResult result =
      inverse_.solve(state, tolerance, log_.begin_step(name_, from, to, tolerance));
  found_.residual = result.residual;
  found_.min_det_F = inverse_.min_det_F();
  return result;
}

// Whether the imaged shape is a stable equilibrium of the unloaded shape found; not if that shape
// is folded. The augmentation that suits multigrid does not necessarily preserve volumes as well as
// incompressibility does.
bool BackwardSteps::stays(const State& state) {
  Timer::Scope phase(found_.timer, "stability");
  if (inverse_.stable(state, 0)) return true;
  return !fail_fast_ && solver_.kind() == LinearSolver::multigrid &&
         inverse_.stable(state, nearly_incompressible);
}

bool BackwardSteps::stands(const Eigen::VectorXd& load, State state) {
  loaded_.set_load(load);
  return attempt(state, 0, 1, inverse_tolerance).converged && stays(state);
}

LoadReached BackwardSteps::follow(const Eigen::VectorXd& load, State& state, double tolerance) {
  LoadSteps steps;
  steps.divide = !fail_fast_;
  steps.set_load = [&](double part) { loaded_.set_load(part * load); };
  steps.solve = [&](State& trial, double from, double to) {
    return attempt(trial, from, to, tolerance);
  };
  return follow_load(steps, state);
}

void BackwardSteps::approach(const Eigen::VectorXd& load, State& state) {
  State near = state;
  if (follow(load, near, rough_tolerance).whole()) state = std::move(near);
}

void BackwardSteps::run(const Eigen::VectorXd& load, State& state) {
  const LoadReached reached = follow(load, state, inverse_tolerance);
  found_.stable = reached.part > 0 ? stays(state) : true;
  judge(reached);
}

// Newton's direction always reduces the residual unless ∂R/∂X is singular: if the solution path
// stops because no step or no direction is found, it ends there. If no load was reached at all, the
// steps may have been too long.
void BackwardSteps::judge(const LoadReached& reached) {
  const double part = found_.load_reached = reached.part;
  SolveRecord& record = found_.record;
  if (!reached.whole()) {
    const NewtonResult& failure = reached.last;
    const bool ends =
        part > 0 && (failure.stop == NewtonStop::singular_inverse ||
                     failure.stop == NewtonStop::no_step || failure.stop == NewtonStop::folded);
    found_.reason_id = ends ? "no_stress_free_body" : stop_name(failure.stop);
    record.reason = message("stopped at ", 100 * part, " % of the load: ", failure.reason);
    if (ends) {
      record.reason = message(
          "no stress-free body: the family of stress-free shapes that gravity deforms into the "
          "imaged one ends near ",
          100 * part, " % of the load (", failure.reason, ")");
    }
  } else if (!found_.stable) {
    record.status = SolveStatus::unstable;
    found_.reason_id = unstable_equilibrium;
    record.reason =
        "unstable equilibrium: the imaged shape is an equilibrium of the body found, but not a "
        "stable one";
  } else {
    record.status = SolveStatus::converged;
  }
}

}  // namespace breast
