// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "core/error.hpp"
#include "distributed/collected.hpp"
#include "distributed/distributed.hpp"
#include "distributed/part_equilibrium.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/solve_pace.hpp"
#include "mesh/nodal.hpp"

namespace breast {

namespace {

constexpr int first_limit = 25, later_limit = 12;  // Newton iterations of a load step
constexpr double tolerance = 1e-10;

class ForwardOnRanks {
 public:
  ForwardOnRanks(const PartProblem& problem, Progress& progress)
      : problem_(problem),
        progress_(progress),
        solver_(problem),
        matrix_(problem.own().make_matrix()) {}

  /// Increases the load from `state`; on success, `state` is the equilibrium.
  void follow(PartProblem& load, State& state);
  Equilibrium found;

 private:
  bool attempt(State& state, double from, double to);
  void judge(const State& state);
  bool definite(const State& state, double augmentation);
  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  const PartProblem& problem_;
  Progress& progress_;
  PartSaddle solver_;
  SaddleMatrix matrix_;
  NewtonResult last_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool ForwardOnRanks::attempt(State& state, double from, double to) {
  PartEquilibrium system(problem_, solver_, matrix_, state,
                         found.steps == 0 ? first_limit : later_limit, found.timer);
  ++found.steps;
  SolvePace pace(tolerance);
  last_ = newton(system, [&](const NewtonIteration& iteration) {
    record_iteration(found, found.steps, iteration, clock());
    progress_.update(
        "forward-mpi", from + (to - from) * pace.after(iteration),
        message("iteration ", found.newton_iterations, ", residual ", iteration.residual));
  });
  found.residual = last_.residual;
  found.min_det_F = system.forces().min_det_F;
  return last_.converged;
}

void ForwardOnRanks::follow(PartProblem& load, State& state) {
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
  if (path.finished()) {
    judge(state);
  } else {
    found.reason_id = stop_name(last_.stop);
    found.load_reached = path.done;
    found.record.reason = message("stopped at ", 100 * path.done, " % of the load: ", last_.reason);
  }
  note_solver(solver_, found);
}

bool ForwardOnRanks::definite(const State& state, double augmentation) {
  Request request;
  request.matrix = &matrix_;
  request.augmentation = augmentation;
  return problem_.evaluate(state, request).valid &&
         solver_.factorise(matrix_, problem_.constraints_at(state.x)) &&
         solver_.positive_definite();
}

// The last multigrid levels show this, for a neighbouring state. The augmentation that suits them
// does not necessarily preserve volumes as well as incompressibility does.
void ForwardOnRanks::judge(const State& state) {
  Timer::Scope phase(found.timer, "stability");
  found.stable = (solver_.factorisations() > 0 && solver_.positive_definite()) ||
                 definite(state, 0) || definite(state, nearly_incompressible);
  if (found.stable) {
    found.record.status = SolveStatus::converged;
    return;
  }
  found.record.status = SolveStatus::unstable;
  found.reason_id = unstable_equilibrium;
  found.record.reason =
      "unstable equilibrium: the shape found is in balance but the breast would not stay in it";
}

}  // namespace

Equilibrium solve_forward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                             const MechanicsOptions& options, Progress& progress) {
  MechanicsOptions chosen;
  ranks.together([&] {
    chosen = options_for_ranks(options);
    if (ranks.root() && mesh.reference.size() != mesh.points.size()) {
      throw input_error("mesh: no stress-free reference shape; run backward first");
    }
  });
  Timer timer;
  MeshPart part;
  {
    Timer::Scope phase(timer, "partition");
    part = share_mesh(ranks, mesh, chosen);
  }
  PartProblem problem(ranks, part, chosen);
  problem.set_gravity(gravity);
  State state = problem.at_rest(flatten(part.mesh.reference));
  Equilibrium found;
  {
    ForwardOnRanks solve(problem, progress);
    solve.found.timer = timer;
    solve.follow(problem, state);
    found = std::move(solve.found);
  }
  conclude_on(problem, mesh, chosen, state, gravity, found);
  return found;
}

}  // namespace breast
