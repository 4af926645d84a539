// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/load_steps.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"
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

  /// A solve that increases the load from the fraction `from` to the fraction `to`.
  NewtonResult attempt(Workspace& work, State& state, double from = 0, double to = 1);
  NewtonResult follow(Workspace& work, const Eigen::VectorXd& load, State& state);
  std::unique_ptr<Workspace> workspace(const Eigen::VectorXd& load);
  bool stays(Workspace& work, const State& state);
  void judge(Workspace& work, const State& state);
  void estimate(Workspace& work, const State& state, const Vec3& gravity);

  const HexMesh& mesh_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
  Equilibrium found_;
  SolveLog log_{found_, progress_};
};

NewtonResult ForwardSolve::attempt(Workspace& work, State& state, double from, double to) {
  NewtonOptions options;
  options.max_iterations = found_.steps == 0 ? first_limit : later_limit;
  options.reuse_factor = true;
  options.fail_fast = fail_fast_;
  options.timer = &found_.timer;
  const EquilibriumResult result =
      equilibrate(work.loaded.problem, work.solver, work.matrix, state, options, nullptr,
                  log_.begin_step("forward", from, to, options.tolerance));
  found_.factorisations += result.factorisations;
  found_.residual = result.residual;
  found_.min_det_F = result.forces.min_det_F;
  return result;
}

// Increases the load from `state`, which is then the last equilibrium.
NewtonResult ForwardSolve::follow(Workspace& work, const Eigen::VectorXd& load, State& state) {
  LoadSteps steps;
  steps.divide = !fail_fast_;
  steps.set_load = [&](double part) { work.loaded.set_load(part * load); };
  steps.solve = [&](State& trial, double from, double to) {
    return attempt(work, trial, from, to);
  };
  LoadReached reached = follow_load(steps, state);
  if (!reached.whole()) {
    found_.reason_id = stop_name(reached.last.stop);
    found_.load_reached = reached.part;
    found_.record.reason =
        message("stopped at ", 100 * reached.part, " % of the load: ", reached.last.reason);
  }
  return std::move(reached.last);
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
  note_estimate(estimate_error(scene_, state, gravity, work.matrix, work.solver), "", found_);
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
  const NewtonResult result = follow(*work, load, state);
  note_solver(work->solver, work->matrix, found_);
  if (result.converged) judge(*work, state);
  if (found_.converged()) estimate(*work, state, gravity);
  work.reset();
  if (fail_fast_ && !found_.converged()) return found_;
  if (!found_.converged()) {
    find_remedy(
        mesh_, scene_.options(),
        [&](const MechanicsOptions& changed) {
          return ForwardSolve(mesh_, changed, false, no_progress()).stands(gravity);
        },
        progress_, found_);
  }
  if (result.indefinite > 0) {
    found_.doubts.push_back(message("the tangent was indefinite in ", result.indefinite,
                                    " iterations: the breast may buckle"));
  }
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
