// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/load_steps.hpp"

#include "core/error.hpp"
#include "distributed/collected.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/solve_pace.hpp"
#include "mesh/nodal.hpp"

namespace breast {

LoadSteps::LoadSteps(const PartProblem& problem, std::string tool, double tolerance,
                     Progress& progress)
    : problem_(problem),
      solver_(problem),
      matrix_(problem.own().make_matrix()),
      tool_(std::move(tool)),
      tolerance_(tolerance),
      progress_(progress) {}

NewtonResult LoadSteps::iterate(NewtonSystem& system, double from, double to) {
  ++found.steps;
  SolvePace pace(tolerance_);
  const NewtonResult result = newton(system, [&](const NewtonIteration& iteration) {
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
    record_iteration(found, found.steps, iteration, clock.count());
    progress_.update(
        tool_, from + (to - from) * pace.after(iteration),
        message("iteration ", found.newton_iterations, ", residual ", iteration.residual));
  });
  found.residual = result.residual;
  return result;
}

void LoadSteps::follow(PartProblem& load, State& state) {
  LoadPath path;
  NewtonResult failure;
  while (!path.finished()) {
    load.set_load(path.next());
    State trial = state;
    const NewtonResult step = attempt(trial, path.done, path.next());
    if (step.converged) {
      state = std::move(trial);
      path.succeed();
    } else {
      failure = step;
      if (!path.fail()) break;
    }
  }
  judge(state, path.done, failure);
  note_solver(solver_, found);
}

bool LoadSteps::definite(const State& state, double augmentation) {
  Request request;
  request.matrix = &matrix_;
  request.augmentation = augmentation;
  return problem_.evaluate(state, request).valid &&
         solver_.factorise(matrix_, problem_.constraints_at(state.x)) &&
         solver_.positive_definite();
}

void LoadSteps::conclude_stability(const std::string& unstable) {
  found.record.status = found.stable ? SolveStatus::converged : SolveStatus::unstable;
  if (found.stable) return;
  found.reason_id = unstable_equilibrium;
  found.record.reason = "unstable equilibrium: " + unstable;
}

Equilibrium solve_on_ranks(const Ranks& ranks, const HexMesh& mesh, const MechanicsOptions& options,
                           std::vector<Vec3> HexMesh::*start, const Vec3& gravity,
                           const Vec3& gravity_found, const MakeLoadSteps& make) {
  Timer timer;
  MeshPart part;
  {
    Timer::Scope phase(timer, "partition");
    part = share_mesh(ranks, mesh, options);
  }
  PartProblem problem(ranks, part, options);
  problem.set_gravity(gravity);
  State state = problem.at_rest(flatten(part.mesh.*start));
  Equilibrium found;
  {
    const std::unique_ptr<LoadSteps> steps = make(problem);
    steps->found.timer = timer;
    steps->follow(problem, state);
    found = std::move(steps->found);
  }
  conclude_on(problem, mesh, options, state, gravity_found, found);
  return found;
}

}  // namespace breast
