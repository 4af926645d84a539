// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/forward_steps.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/stability/explain.hpp"

namespace breast {

namespace {

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

  std::optional<State> guess(const Eigen::VectorXd& load, State rest) const;
  std::unique_ptr<Workspace> workspace(const Eigen::VectorXd& load);
  ForwardSteps steps(Workspace& work) {
    return {work.loaded, work.solver, work.matrix, fail_fast_, "forward", found_, progress_};
  }
  void estimate(Workspace& work, const State& state, const Vec3& gravity);

  const HexMesh& mesh_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
  Equilibrium found_;
};

void ForwardSolve::estimate(Workspace& work, const State& state, const Vec3& gravity) {
  if (mesh_.order != 1 || mesh_.landmarks.empty()) return;
  if (scene_.options().estimate != Estimate::step) return;
  Timer::Scope phase(found_.timer, "error estimate");
  progress_.update("error estimate", -1, "one step on quadratic elements");
  note_estimate(estimate_error(scene_, state, gravity, work.matrix, work.solver), "", found_);
}

// A load against that of the scan moves the body about the other way. Newton's method needs only a small part of
// it: at rest skin lies between wrinkled and taut, and a start beyond this kink halves the factorisations of heavy
// breasts. Three tenths are too far for them.
std::optional<State> ForwardSolve::guess(const Eigen::VectorXd& load, State rest) const {
  constexpr double part = 0.15;
  const Eigen::VectorXd scanned = flatten(mesh_.imaged) - rest.reference;
  if (!(load.dot(scanned) < 0)) return {};
  rest.x -= part * scanned;
  return rest;
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
  return steps(*work).stands(state);
}

Equilibrium ForwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  State state = scene_.at_rest(flatten(mesh_.reference));
  auto work = workspace(load);
  const NewtonResult last = steps(*work).run(load, state, guess(load, state));
  note_solver(work->solver, work->matrix, found_);
  if (!found_.stable && !fail_fast_) {
    note_instability(find_instability(work->loaded.problem, state, work->matrix, work->solver),
                     found_);
  }
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
  if (last.indefinite > 0) {
    found_.doubts.push_back(message("the tangent was indefinite in ", last.indefinite,
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
