// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/solution.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "material/stability.hpp"
#include "mechanics/field_checks.hpp"
#include "mesh/quality.hpp"
#include "mesh/shape.hpp"

namespace breast {

void note_solver(const SaddleSolver& solver, const SaddleMatrix& matrix, SolveSummary& summary) {
  summary.linear_solver = solver.kind() == LinearSolver::direct ? "direct" : "multigrid";
  summary.matrix_values = double(matrix.stiffness.values().size());
  summary.factor_values = solver.factor_entries();
  summary.factor_gflop = solver.factor_gflop();
}

namespace {

// Elements with a law that is not proved elliptic and has lost ellipticity at the centre of the
// element.
int beyond_stable_range(const Scene& scene, const State& state) {
  const HexMesh& mesh = scene.mesh();
  const HexShape centre = hex_shape(mesh.order, Vec3::Zero());
  int beyond = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Law& law = scene.options().materials.law(mesh.tissue[e]);
    if (always_elliptic(law)) continue;
    Mat3 from = Mat3::Zero(), to = Mat3::Zero();
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      const int node = mesh.element(e)[a];
      from += state.reference.segment<3>(3L * node) * centre.gradients.col(a).transpose();
      to += state.x.segment<3>(3L * node) * centre.gradients.col(a).transpose();
    }
    Mat3 f = to * from.inverse();
    f /= std::cbrt(f.determinant());
    if (!(weakest_shear(law, f * f.transpose()) > 0)) ++beyond;
  }
  return beyond;
}

void judge(Equilibrium& equilibrium, const Scene& scene, const State& state) {
  const std::vector<double> quality = scaled_jacobians(scene.mesh(), equilibrium.points);
  const auto poor =
      std::count_if(quality.begin(), quality.end(), [](double q) { return !(q >= 0.1); });
  if (poor > 0) {
    equilibrium.doubts.push_back(message(poor, " elements have a scaled Jacobian below 0.1"));
  }
  const int beyond = beyond_stable_range(scene, state);
  if (beyond > 0) {
    equilibrium.doubts.push_back(
        message(beyond, " elements are strained beyond the stable range of their law"));
  }
  if (equilibrium.min_det_F > 0 && equilibrium.min_det_F < 0.3) {
    equilibrium.doubts.push_back(message("smallest det F ", equilibrium.min_det_F,
                                         " inside an element: refine the mesh there"));
  }
}

}  // namespace

void conclude(Equilibrium& equilibrium, const Scene& scene, const State& state,
              const Vec3& gravity) {
  equilibrium.reference = unflatten(state.reference);
  equilibrium.points = unflatten(state.x);
  equilibrium.gravity = gravity;
  equilibrium.pressure = scene.solid().mean_pressure(state.p);
  equilibrium.det_F = scene.solid().mean_det_f(state.reference, state.x);
  equilibrium.unknowns = scene.unknowns();
  equilibrium.max_volume_error = 0;
  for (const double j : equilibrium.det_F) {
    equilibrium.max_volume_error = std::max(equilibrium.max_volume_error, std::abs(j - 1));
  }
  judge(equilibrium, scene, state);
  check_fields(scene, equilibrium);
}

}  // namespace breast
