#include <chrono>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"
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

 private:
  // What a solve holds beside its state; freed before results are gathered.
  struct Workspace {
    LoadedProblem loaded;
    SaddleMatrix matrix;
    SaddleSolver solver;
  };

  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  EquilibriumResult attempt(Workspace& work, State& state);
  EquilibriumResult follow(Workspace& work, const Eigen::VectorXd& load, State& state);
  void check_stability(Workspace& work, const State& state);
  void estimate(Workspace& work, const State& state, const Vec3& gravity);

  const HexMesh& mesh_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
  Equilibrium found_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

EquilibriumResult ForwardSolve::attempt(Workspace& work, State& state) {
  NewtonOptions options;
  options.max_iterations = found_.steps == 0 ? first_limit : later_limit;
  options.reuse_factor = true;
  options.fail_fast = fail_fast_;
  options.timer = &found_.timer;
  ++found_.steps;
  EquilibriumResult result = equilibrate(
      work.loaded.problem, work.solver, work.matrix, state, options, nullptr,
      [&](const NewtonIteration& iteration) {
        record_iteration(found_, found_.steps, iteration, clock());
        progress_.update("forward", -1,
                         message("iteration ", found_.newton_iterations, ", residual ",
                                 iteration.residual));
      });
  found_.factorisations += result.factorisations;
  return result;
}

// Follows the load from `state`; on success that is the last equilibrium.
EquilibriumResult ForwardSolve::follow(Workspace& work, const Eigen::VectorXd& load,
                                       State& state) {
  EquilibriumResult result;
  LoadPath path;
  while (!path.finished()) {
    work.loaded.set_load(path.next() * load);
    State trial = state;
    result = attempt(work, trial);
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

// Whether the equilibrium found is known to be stable, from the last tangent. Where the start was
// the equilibrium there is no factor of it yet.
void ForwardSolve::check_stability(Workspace& work, const State& state) {
  Timer::Scope phase(found_.timer, "stability");
  if (work.solver.factorisations() == 0) {
    work.solver.factorise(work.matrix, work.loaded.problem.constraints_at(state.x), false);
  }
  found_.stable = work.solver.positive_definite();
  if (found_.stable) return;
  if (fail_fast_) {
    found_.record.status = SolveStatus::not_converged;
    found_.record.reason = "the equilibrium found is not known to be stable";
  } else {
    found_.doubts.push_back(unknown_stability);
  }
}

void ForwardSolve::estimate(Workspace& work, const State& state, const Vec3& gravity) {
  if (mesh_.order != 1 || mesh_.landmarks.empty()) return;
  if (scene_.options().estimate != Estimate::step) return;
  Timer::Scope phase(found_.timer, "error estimate");
  note_estimate(estimate_error(scene_, state, gravity, work.matrix, work.solver), "",
                found_);
}

Equilibrium ForwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  State state = scene_.at_rest(flatten(mesh_.reference));
  EquilibriumResult result;
  {
    Workspace work{scene_.problem(load), scene_.solid().space()->make_matrix(), [&] {
                     Timer::Scope phase(found_.timer, "ordering");
                     return SaddleSolver(scene_.solid().space()->pattern, scene_.solid().solver());
                   }()};
    result = follow(work, load, state);
    if (result.converged) found_.record.status = SolveStatus::converged;
    note_solver(work.solver, work.matrix, found_);
    if (result.converged) check_stability(work, state);
    if (found_.converged()) estimate(work, state, gravity);
  }
  if (fail_fast_ && !found_.converged()) return found_;
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
