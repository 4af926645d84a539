// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

Equilibrium solve_backward_fixed_point(const HexMesh& mesh, const Vec3& gravity,
                                       const MechanicsOptions& options, double tolerance_mm,
                                       int max_iterations, Progress& progress) {
  const Scene scene(mesh, options);
  const Eigen::VectorXd imaged = flatten(mesh.imaged);
  const LoadedProblem loaded = scene.problem(scene.gravity_force(gravity));
  SaddleSolver solver(scene.solid().space()->pattern);
  SaddleMatrix matrix = loaded.problem.make_matrix();
  State state = scene.at_rest(imaged);
  Equilibrium found;
  double distance = 0;
  for (int i = 0; i < max_iterations; ++i) {
    const EquilibriumResult result = equilibrate(loaded.problem, solver, matrix, state);
    found.newton_iterations += int(result.iterations.size());
    found.residual = result.residual;
    found.min_det_F = result.forces.min_det_F;
    ++found.steps;
    if (!result.converged) {
      found.reason_id = stop_name(result.stop);
      found.record.reason = message("forward solve ", i + 1, " failed: ", result.reason);
      break;
    }
    const Eigen::VectorXd miss = state.x - imaged;
    distance = miss.lpNorm<Eigen::Infinity>();
    progress.update("fixed point", -1, message("iteration ", i + 1, ", ", distance, " mm"));
    if (distance <= tolerance_mm) {
      found.record.status = SolveStatus::converged;
      break;
    }
    state.reference -= miss;
    state.x -= miss;
    if (loaded.problem.restore(state.reference) >= 0) {
      found.reason_id = stop_name(NewtonStop::left_surface);
      found.record.reason = describe(NewtonStop::left_surface);
      break;
    }
  }
  if (!found.converged() && found.record.reason.empty()) {
    found.reason_id = stop_name(NewtonStop::iteration_limit);
    found.record.reason =
        message(max_iterations, " fixed-point iterations leave ", distance, " mm");
  }
  found.factorisations = solver.factorisations();
  conclude(found, scene, state, Vec3::Zero());
  found.points = found.reference;
  return found;
}

}  // namespace breast
