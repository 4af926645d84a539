// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "core/error.hpp"
#include "distributed/collected.hpp"
#include "distributed/distributed.hpp"
#include "distributed/part_inverse.hpp"
#include "mechanics/inverse_system.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/solve_pace.hpp"
#include "mesh/nodal.hpp"

namespace breast {

namespace {

class BackwardOnRanks {
 public:
  BackwardOnRanks(const PartProblem& problem, Progress& progress)
      : problem_(problem),
        progress_(progress),
        solver_(problem),
        matrix_(problem.own().make_matrix()) {}

  /// Increases the load from `state` to the full load, in parts if necessary.
  void follow(PartProblem& load, State& state);
  Equilibrium found;

 private:
  bool attempt(State& state, double from, double to);
  void judge(const State& state, double reached);
  bool stays(const State& state, double augmentation);
  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  const PartProblem& problem_;
  Progress& progress_;
  PartSaddle solver_;
  SaddleMatrix matrix_;
  NewtonResult failure_;  // the last one that did not converge
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool BackwardOnRanks::attempt(State& state, double from, double to) {
  PartInverse system(problem_, solver_, matrix_, state, found.timer);
  ++found.steps;
  SolvePace pace(inverse_tolerance);
  const NewtonResult result = newton(system, [&](const NewtonIteration& iteration) {
    record_iteration(found, found.steps, iteration, clock());
    progress_.update(
        "backward-mpi", from + (to - from) * pace.after(iteration),
        message("iteration ", found.newton_iterations, ", residual ", iteration.residual));
  });
  found.residual = result.residual;
  found.min_det_F = system.forces().min_det_F;
  if (!result.converged) failure_ = result;
  return result.converged;
}

void BackwardOnRanks::follow(PartProblem& load, State& state) {
  LoadPath path;
  while (!path.finished()) {
    load.set_load(path.next());
    State trial = state;
    if (attempt(trial, path.done, path.next())) {
      state = std::move(trial);
      path.succeed();
    } else if (!path.fail()) {
      break;
    }
  }
  judge(state, path.done);
  note_solver(solver_, found);
}

// Whether the imaged shape is a stable equilibrium of the unloaded shape found.
bool BackwardOnRanks::stays(const State& state, double augmentation) {
  Request request;
  request.matrix = &matrix_;
  request.augmentation = augmentation;
  return problem_.evaluate(state, request).valid &&
         solver_.factorise(matrix_, problem_.constraints_at(state.x)) &&
         solver_.positive_definite();
}

void BackwardOnRanks::judge(const State& state, double reached) {
  found.load_reached = reached;
  if (reached < 1) {
    const bool ends = reached > 0 &&
                      (failure_.stop == NewtonStop::singular_inverse ||
                       failure_.stop == NewtonStop::no_step || failure_.stop == NewtonStop::folded);
    found.reason_id = ends ? "no_stress_free_body" : stop_name(failure_.stop);
    found.record.reason =
        message("stopped at ", 100 * reached, " % of the load: ", failure_.reason);
    return;
  }
  Timer::Scope phase(found.timer, "stability");
  found.stable = stays(state, 0) || stays(state, nearly_incompressible);
  if (found.stable) {
    found.record.status = SolveStatus::converged;
    return;
  }
  found.record.status = SolveStatus::unstable;
  found.reason_id = unstable_equilibrium;
  found.record.reason =
      "unstable equilibrium: the body found is in balance in the imaged shape but would not stay in "
      "it";
}

}  // namespace

Equilibrium solve_backward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                              const MechanicsOptions& options, Progress& progress) {
  MechanicsOptions chosen;
  ranks.together([&] { chosen = options_for_ranks(options); });
  Timer timer;
  MeshPart part;
  {
    Timer::Scope phase(timer, "partition");
    part = share_mesh(ranks, mesh, chosen);
  }
  PartProblem problem(ranks, part, chosen);
  problem.set_gravity(gravity);
  State state = problem.at_rest(flatten(part.mesh.imaged));
  Equilibrium found;
  {
    BackwardOnRanks solve(problem, progress);
    solve.found.timer = timer;
    solve.follow(problem, state);
    found = std::move(solve.found);
  }
  conclude_on(problem, mesh, chosen, state, Vec3::Zero(), found);
  found.points = found.reference;
  return found;
}

}  // namespace breast
