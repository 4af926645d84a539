#include "mechanics/solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

void record_iteration(SolveSummary& summary, int step, const NewtonIteration& iteration,
                      double clock) {
  IterationRecord record;
  record.step = step;
  record.iteration = ++summary.newton_iterations;
  record.residual = iteration.residual;
  record.min_det_F = iteration.min_det_F;
  record.max_det_F = iteration.max_det_F;
  record.step_length = iteration.step_length;
  record.seconds = clock;
  summary.record.iterations.push_back(record);
}

void store_state(HexMesh& mesh, const Scene& scene, const Eigen::VectorXd& reference,
                 const SaddleState& state, SolveSummary& summary) {
  const Assembly& assembly = scene.assembly();
  mesh.reference = unflatten(reference);
  mesh.points = unflatten(state.u);
  mesh.pressure = assembly.mean_pressure(state.p);
  mesh.det_F = assembly.mean_det_f(reference, state.u);
  summary.unknowns = scene.unknowns();
  summary.max_volume_error = 0;
  for (const double j : mesh.det_F) {
    summary.max_volume_error = std::max(summary.max_volume_error, std::abs(j - 1));
  }
  mesh.solve = summary.record;
}

void judge(SolveSummary& summary, const Scene& scene, const Eigen::VectorXd&, const SaddleState&) {
  const HexMesh& mesh = scene.mesh();
  const auto poor = std::count_if(mesh.scaled_jacobian.begin(), mesh.scaled_jacobian.end(),
                                  [](double quality) { return quality < 0.1; });
  if (poor > 0) {
    summary.doubts.push_back(message(poor, " elements have a scaled Jacobian below 0.1"));
  }
}

}  // namespace breast
