// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <memory>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/solve_pace.hpp"
#include "mechanics/stability/explain.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

constexpr int first_limit = 25, later_limit = 12;  // Newton iterations of a load step

class ForwardSolve {
 public:
  ForwardSolve(const HexMesh& mesh, const MechanicsOptions& options, bool fail_fast,
               Progress& progress)
      : mesh_(mesh), scene_(mesh, options), fail_fast_(fail_fast), progress_(progress) {}

  Equilibrium run(const Vec3& gravity);
  /// Whether a stable equilibrium is found in one step.
  bool stands(const Vec3& gravity);

 private:
  // The data of a solve besides its state; freed before results are gathered.
  struct Workspace {
    LoadedProblem loaded;
    SaddleMatrix matrix;
    SaddleSolver solver;
  };

  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// A solve that increases the load from the fraction `from` to the fraction `to`.
  EquilibriumResult attempt(Workspace& work, State& state, double from = 0, double to = 1);
  EquilibriumResult follow(Workspace& work, const Eigen::VectorXd& load, State& state);
  std::unique_ptr<Workspace> workspace(const Eigen::VectorXd& load);
  bool stays(Workspace& work, const State& state);
  void judge(Workspace& work, const State& state);
  void estimate(Workspace& work, const State& state, const Vec3& gravity);

  const HexMesh& mesh_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
  Equilibrium found_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

EquilibriumResult ForwardSolve::attempt(Workspace& work, State& state, double from, double to) {
  NewtonOptions options;
  options.max_iterations = found_.steps == 0 ? first_limit : later_limit;
  options.reuse_factor = true;
  options.fail_fast = fail_fast_;
  options.timer = &found_.timer;
  ++found_.steps;
  SolvePace pace(options.tolerance);
  EquilibriumResult result = equilibrate(
      work.loaded.problem, work.solver, work.matrix, state, options, nullptr,
      [&](const NewtonIteration& iteration) {
        record_iteration(found_, found_.steps, iteration, clock());
        progress_.update("forward", from + (to - from) * pace.after(iteration),
                         message("iteration ", found_.newton_iterations, ", residual ",
                                 iteration.residual));
      });
  found_.factorisations += result.factorisations;
  return result;
}

// Increases the load from `state`; on success, `state` is then the last equilibrium.
EquilibriumResult ForwardSolve::follow(Workspace& work, const Eigen::VectorXd& load,
                                       State& state) {
  EquilibriumResult result;
  LoadPath path;
  while (!path.finished()) {
    work.loaded.set_load(path.next() * load);
    State trial = state;
    result = attempt(work, trial, path.done, path.next());
    if (result.converged) {
      state = std::move(trial);
      path.succeed();
    } else if (fail_fast_ || !path.fail()) {
      found_.reason_id = stop_name(result.stop);
      found_.load_reached = path.done;
      found_.record.reason =
          message("stopped at ", 100 * path.done, " % of the load: ", result.reason);
      break;
    }
  }
  return result;
}

// Whether the equilibrium found is known to be stable. The last factor shows this for a
// neighbouring state; if that factor was shifted, or if there is none yet, a factor of the state
// itself is computed. The augmentation that suits multigrid does not necessarily preserve volumes
// as well as incompressibility does.
bool ForwardSolve::stays(Workspace& work, const State& state) {
  Timer::Scope phase(found_.timer, "stability");
  if (work.solver.factorisations() > 0 && work.solver.positive_definite()) return true;
  Request request;
  request.matrix = &work.matrix;
  const auto definite = [&](double augmentation) {
    request.augmentation = augmentation;
    const Problem& problem = work.loaded.problem;
    return problem.evaluate(state, request).valid &&
           work.solver.factorise(work.matrix, problem.constraints_at(state.x), false).ok &&
           work.solver.positive_definite();
  };
  return definite(0) || (!fail_fast_ && work.solver.kind() == LinearSolver::multigrid &&
                         definite(nearly_incompressible));
}

// An unstable equilibrium is not accepted as a solution.
void ForwardSolve::judge(Workspace& work, const State& state) {
  found_.stable = stays(work, state);
  if (found_.stable) {
    found_.record.status = SolveStatus::converged;
    return;
  }
  found_.record.status = SolveStatus::unstable;
  found_.reason_id = unstable_equilibrium;
  found_.record.reason =
      "unstable equilibrium: the shape found is an equilibrium, but not a stable one";
  if (fail_fast_) return;
  note_instability(find_instability(work.loaded.problem, state, work.matrix, work.solver), found_);
}

void ForwardSolve::estimate(Workspace& work, const State& state, const Vec3& gravity) {
  if (mesh_.order != 1 || mesh_.landmarks.empty()) return;
  if (scene_.options().estimate != Estimate::step) return;
  Timer::Scope phase(found_.timer, "error estimate");
  progress_.update("error estimate", -1, "one step on quadratic elements");
  note_estimate(estimate_error(scene_, state, gravity, work.matrix, work.solver), "",
                found_);
}

std::unique_ptr<ForwardSolve::Workspace> ForwardSolve::workspace(const Eigen::VectorXd& load) {
  Timer::Scope phase(found_.timer, "ordering");
  return std::unique_ptr<Workspace>(
      new Workspace{scene_.problem(load), scene_.solid().space()->make_matrix(),
                    SaddleSolver(scene_.solid().space()->pattern, scene_.solid().solver())});
}

bool ForwardSolve::stands(const Vec3& gravity) {
  const auto work = workspace(scene_.gravity_force(gravity));
  State state = scene_.at_rest(flatten(mesh_.reference));
  return attempt(*work, state).converged && stays(*work, state);
}

Equilibrium ForwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  State state = scene_.at_rest(flatten(mesh_.reference));
  auto work = workspace(load);
  const EquilibriumResult result = follow(*work, load, state);
  note_solver(work->solver, work->matrix, found_);
  if (result.converged) judge(*work, state);
  if (found_.converged()) estimate(*work, state, gravity);
  work.reset();
  if (fail_fast_ && !found_.converged()) return found_;
  if (!found_.converged()) {
    find_remedy(mesh_, scene_.options(), [&](const MechanicsOptions& changed) {
      return ForwardSolve(mesh_, changed, false, no_progress()).stands(gravity);
    }, progress_, found_);
  }
  if (result.indefinite > 0) {
    found_.doubts.push_back(message("the tangent was indefinite in ", result.indefinite,
                                    " iterations: the breast may buckle"));
  }
  found_.residual = result.residual;
  found_.min_det_F = result.forces.min_det_F;
  conclude(found_, scene_, state, gravity);
  return found_;
}

}  // namespace

Equilibrium solve_forward(const HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                          Progress& progress) {
  if (mesh.reference.size() != mesh.points.size()) {
    throw input_error("mesh: no stress-free reference shape; run backward first");
  }
  return with_chosen_solver(3.0 * mesh.nodes(), options, progress,
                            [&](const MechanicsOptions& chosen, bool fail_fast) {
                              return ForwardSolve(mesh, chosen, fail_fast, progress).run(gravity);
                            });
}

}  // namespace breast
