// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/forward_steps.hpp"

#include "core/error.hpp"
#include "mechanics/solution.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

constexpr int first_limit = 25, later_limit = 12;  // Newton iterations of a load step

}  // namespace

ForwardSteps::ForwardSteps(LoadedProblem& loaded, SaddleSolverBase& solver, SaddleMatrix& matrix,
                           bool fail_fast, std::string name, Equilibrium& found, Progress& progress)
    : loaded_(loaded),
      solver_(solver),
      matrix_(matrix),
      fail_fast_(fail_fast),
      name_(std::move(name)),
      found_(found),
      log_(found, progress) {}

NewtonResult ForwardSteps::attempt(State& state, double from, double to) {
  NewtonOptions options;
  options.max_iterations = found_.steps == 0 ? first_limit : later_limit;
  options.reuse_factor = true;
  options.fail_fast = fail_fast_;
  options.timer = &found_.timer;
  const EquilibriumResult result =
      equilibrate(loaded_.problem, solver_, matrix_, state, options, nullptr,
                  log_.begin_step(name_, from, to, options.tolerance));
  found_.factorisations += result.factorisations;
  found_.residual = result.residual;
  found_.min_det_F = result.forces.min_det_F;
  return result;
}

// Whether the equilibrium found is known to be stable. The last factor shows this for a
// neighbouring state; if that factor was shifted, or if there is none yet, a factor of the state
// itself is computed. The augmentation that suits multigrid does not necessarily preserve volumes
// as well as incompressibility does.
bool ForwardSteps::stays(const State& state) {
  Timer::Scope phase(found_.timer, "stability");
  if (solver_.factorisations() > 0 && solver_.positive_definite()) return true;
  Request request;
  request.matrix = &matrix_;
  const auto definite = [&](double augmentation) {
    request.augmentation = augmentation;
    const Problem& problem = loaded_.problem;
    return problem.evaluate(state, request).valid &&
           solver_.factorise(matrix_, problem.constraints_at(state.x), false).ok &&
           solver_.positive_definite();
  };
  return definite(0) || (!fail_fast_ && solver_.kind() == LinearSolver::multigrid &&
                         definite(nearly_incompressible));
}

NewtonResult ForwardSteps::run(const Eigen::VectorXd& load, State& state,
                               std::optional<State> guess) {
  return run([&load](double part) -> Eigen::VectorXd { return part * load; }, state,
             std::move(guess));
}

// An unstable equilibrium is not accepted as a solution.
NewtonResult ForwardSteps::run(const std::function<Eigen::VectorXd(double)>& load_at, State& state,
                               std::optional<State> guess) {
  LoadSteps steps;
  steps.guess = std::move(guess);
  steps.divide = !fail_fast_;
  steps.set_load = [&](double part) { loaded_.set_load(load_at(part)); };
  steps.solve = [&](State& trial, double from, double to) { return attempt(trial, from, to); };
  LoadReached reached = follow_load(steps, state);
  if (!reached.whole()) {
    found_.reason_id = stop_name(reached.last.stop);
    found_.load_reached = reached.part;
    found_.record.reason =
        message("stopped at ", 100 * reached.part, " % of the load: ", reached.last.reason);
    return std::move(reached.last);
  }
  found_.stable = stays(state);
  found_.record.status = found_.stable ? SolveStatus::converged : SolveStatus::unstable;
  if (!found_.stable) {
    found_.reason_id = unstable_equilibrium;
    found_.record.reason =
        "unstable equilibrium: the shape found is an equilibrium, but not a stable one";
  }
  return std::move(reached.last);
}

}  // namespace breast
