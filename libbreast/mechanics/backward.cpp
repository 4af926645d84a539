// SPDX-License-Identifier: GPL-3.0-or-later
// The inverse problem: X such that the imaged shape x is in equilibrium. The residual is that of
// forward, R(X, x, p) = 0 with x given, so that forward returns the imaged shape to rounding error.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "mechanics/backward_steps.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/stability/explain.hpp"

namespace breast {

namespace {

class BackwardSolve {
 public:
  BackwardSolve(const HexMesh& mesh, const MechanicsOptions& options, bool fail_fast,
                Progress& progress)
      : scene_(mesh, options),
        fail_fast_(fail_fast),
        progress_(progress),
        imaged_(flatten(mesh.imaged)),
        loaded_(scene_.problem(Eigen::VectorXd::Zero(3L * mesh.nodes()))),
        solver_(loaded_.problem.space().pattern, scene_.solid().solver()),
        steps_(loaded_, solver_, solve_reference_by(solver_), fail_fast, "backward", found_,
               progress) {
    if (!scene_.corners_resist()) return;
    soft_corners_ = std::make_unique<LoadedProblem>(
        scene_.problem_with_soft_corners(Eigen::VectorXd::Zero(3L * mesh.nodes())));
    first_steps_ =
        std::make_unique<BackwardSteps>(*soft_corners_, solver_, solve_reference_by(solver_),
                                        fail_fast, "backward", found_, progress);
  }

  Equilibrium run(const Vec3& gravity);
  /// Whether a body that is stable in the imaged shape is found in one step.
  bool stands(const Vec3& gravity) { return stands_under(scene_.gravity_force(gravity)); }

 private:
  State guess() const { return {imaged_, imaged_, scene_.solid().rest_pressure()}; }
  State start(const Eigen::VectorXd& load);
  bool stands_under(const Eigen::VectorXd& load) { return steps_.stands(load, start(load)); }
  double stable_part(const Eigen::VectorXd& load, double reached, bool stable);
  void find_needed_stiffness(const Eigen::VectorXd& load);
  Equilibrium finish(const State& state);

  Equilibrium found_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
  Eigen::VectorXd imaged_;
  LoadedProblem loaded_;
  SaddleSolver solver_;
  BackwardSteps steps_;
  // The same body with corners that resist less; null if they never resist.
  std::unique_ptr<LoadedProblem> soft_corners_;
  std::unique_ptr<BackwardSteps> first_steps_;
};

// Corners resist the changes of volume that a linear step of the whole way makes, so that Newton's steps
// from the imaged shape would be short and many: the body first yields there, roughly solved.
State BackwardSolve::start(const Eigen::VectorXd& load) {
  State state = guess();
  if (first_steps_) first_steps_->approach(load, state);
  return state;
}

// Stiffnesses times s under the full load are the same problem as the part 1/s of the load. Finds
// the largest part, within 10 %, for which the body exists and is stable in the imaged shape.
double BackwardSolve::stable_part(const Eigen::VectorXd& load, double reached, bool stable) {
  if (stable) return reached;
  double low = 0, high = reached;
  for (int i = 0; i < 7 && high > 1.1 * low; ++i) {
    const double part = low > 0 ? std::sqrt(low * high) : 0.4 * high;
    (stands_under(part * load) ? low : high) = part;
  }
  return low;
}

void BackwardSolve::find_needed_stiffness(const Eigen::VectorXd& load) {
  SolveSummary summary = found_;  // summary of the state itself; the search only adds to the time
  const double part = stable_part(load, summary.load_reached, summary.stable);
  summary.timer = found_.timer;
  static_cast<SolveSummary&>(found_) = std::move(summary);
  if (!(part > 0)) return;
  found_.stiffness_factor_needed = 1 / part;
  found_.record.reason +=
      message("; stiffnesses and supports that are all ", std::ceil(100 / part) / 100,
              " times larger would give a stable body");
}

Equilibrium BackwardSolve::finish(const State& state) {
  note_solver(solver_, steps_.inverse().matrix(), found_);
  found_.factorisations = solver_.factorisations();
  conclude(found_, scene_, state, Vec3::Zero());
  found_.points = found_.reference;
  return found_;
}

Equilibrium BackwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  State state = start(load);
  steps_.run(load, state);
  if (!found_.stable && !fail_fast_) {
    SaddleMatrix& matrix = steps_.inverse().lend_matrix();
    note_instability(find_instability(loaded_.problem, state, matrix, solver_), found_);
  }
  if (fail_fast_ && !found_.converged()) return found_;
  if (!found_.converged()) {
    find_needed_stiffness(load);
    find_remedy(
        scene_.mesh(), scene_.options(),
        [&](const MechanicsOptions& changed) {
          return BackwardSolve(scene_.mesh(), changed, false, no_progress()).stands(gravity);
        },
        progress_, found_);
  }
  return finish(state);
}

}  // namespace

Equilibrium solve_backward(const HexMesh& mesh, const Vec3& gravity,
                           const MechanicsOptions& options, Progress& progress) {
  return with_chosen_solver(3.0 * mesh.nodes(), options, progress,
                            [&](const MechanicsOptions& chosen, bool fail_fast) {
                              return BackwardSolve(mesh, chosen, fail_fast, progress).run(gravity);
                            });
}

}  // namespace breast
