#include "core/error.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"

namespace breast {

SolveSummary solve_backward_fixed_point(HexMesh& mesh, const Vec3& gravity,
                                        const MechanicsOptions& options, double tolerance_mm,
                                        int max_iterations, Progress& progress) {
  const Scene scene(mesh, options);
  const Eigen::VectorXd imaged = flatten(mesh.imaged), load = scene.gravity_force(gravity);
  Eigen::VectorXd reference = imaged;
  SaddleSolver solver(scene.assembly().pattern());
  SaddleMatrix matrix = scene.assembly().make_matrix();
  SaddleState state{imaged, scene.assembly().rest_pressure()};
  SolveSummary summary;
  summary.record.status = "not_converged";
  double distance = 0;
  for (int i = 0; i < max_iterations; ++i) {
    const ForwardProblem problem(scene, reference, load);
    const NewtonResult result = newton(problem, solver, matrix, scene.walls(), nullptr, state);
    summary.newton_iterations += int(result.iterations.size());
    summary.residual = result.residual;
    summary.min_det_F = result.forces.min_det_F;
    ++summary.steps;
    if (!result.converged) {
      summary.reason_id = stop_name(result.stop);
      summary.record.reason = message("forward solve ", i + 1, " failed: ", result.reason);
      break;
    }
    const Eigen::VectorXd miss = state.u - imaged;
    distance = miss.lpNorm<Eigen::Infinity>();
    progress.update("fixed point", -1, message("iteration ", i + 1, ", ", distance, " mm"));
    if (distance <= tolerance_mm) {
      summary.record.status = "converged";
      break;
    }
    reference -= miss;
    state.u -= miss;
  }
  if (!summary.converged() && summary.record.reason.empty()) {
    summary.reason_id = stop_name(NewtonStop::iteration_limit);
    summary.record.reason =
        message(max_iterations, " fixed-point iterations leave ", distance, " mm");
  }
  summary.factorisations = solver.factorisations();
  store_state(mesh, scene, reference, state, summary);
  mesh.points = mesh.reference;
  mesh.gravity.setZero();
  return summary;
}

}  // namespace breast
