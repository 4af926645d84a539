// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "material/stability.hpp"
#include "mechanics/deformation.hpp"
#include "mechanics/pressure_filter.hpp"
#include "mesh/quality.hpp"

namespace breast {

void note_solver(const SaddleSolver& solver, const SaddleMatrix& matrix, SolveSummary& summary) {
  summary.linear_solver = solver.kind() == LinearSolver::direct ? "direct" : "multigrid";
  summary.matrix_values = double(matrix.stiffness.values().size());
  summary.factor_values = solver.factor_entries();
  summary.factor_gflop = solver.factor_gflop();
}

namespace {

/// Oscillation relative to the spread of the pressures: 8-node elements have 0.3 to 0.42 on every
/// breast, which the filter removes from the reported values.
constexpr double much_oscillation = 0.5;
/// Fraction of the skin's area; below it there are only one or two folds at a rim or at the edge of
/// a plate.
constexpr double much_wrinkling = 0.02;
/// Wrinkles as long as the breast is deep: the formula holds for skin on an infinitely deep body.
constexpr double longest_meaningful_mm = 100;

std::string length_of_wrinkles(double mm) {
  if (mm > longest_meaningful_mm) return message("longer than ", longest_meaningful_mm, " mm");
  return message("up to ", std::round(mm), " mm");
}
// Elements with a law that is not proved elliptic and has lost ellipticity at the centre of the
// element.
int beyond_stable_range(const Scene& scene, const Equilibrium& found) {
  const HexMesh& mesh = scene.mesh();
  int beyond = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Law& law = scene.options().materials.law(mesh.tissue[e]);
    if (always_elliptic(law)) continue;
    const Mat3 b = isochoric_stretch_at_centre(mesh, e, found.reference, found.points);
    if (!(weakest_shear(law, b) > 0)) ++beyond;
  }
  return beyond;
}

void judge(Equilibrium& equilibrium, const Scene& scene) {
  const std::vector<double> quality = scaled_jacobians(scene.mesh(), equilibrium.points);
  const auto poor =
      std::count_if(quality.begin(), quality.end(), [](double q) { return !(q >= 0.1); });
  if (poor > 0) {
    equilibrium.doubts.push_back(message(poor, " elements have a scaled Jacobian below 0.1"));
  }
  const int beyond = beyond_stable_range(scene, equilibrium);
  if (beyond > 0) {
    equilibrium.doubts.push_back(
        message(beyond, " elements are strained beyond the stable range of their law"));
  }
  if (equilibrium.min_det_F > 0 && equilibrium.min_det_F < 0.3) {
    equilibrium.doubts.push_back(message("smallest det F ", equilibrium.min_det_F,
                                         " inside an element: refine the mesh there"));
  }
}

// Fills pressure_quality (8-node elements) and skin from a solved state, and doubts pressures that
// oscillate and skin that wrinkles.
void check_fields(const Scene& scene, Equilibrium& equilibrium) {
  const HexMesh& mesh = scene.mesh();
  if (scene.options().element == Element::q1p0) {
    equilibrium.pressure_quality =
        pressure_quality(mesh, equilibrium.points, equilibrium.pressure,
                         filter_pressure(mesh, equilibrium.points, equilibrium.pressure));
  }
  for (const auto& [tissue, quality] : equilibrium.pressure_quality) {
    const double share = quality.checkerboard;
    if (share > much_oscillation) {
      equilibrium.doubts.push_back(
          message("pressures of ", tissue_name(tissue), " oscillate from element to element (",
                  std::round(100 * share),
                  " % of their spread): trust only the filtered range in the "
                  "report, or use --element q2p1"));
    }
  }
  equilibrium.skin = skin_state(mesh, scene.options().materials, equilibrium.reference,
                                equilibrium.points, equilibrium.contact_pressure);
  const SkinState& skin = equilibrium.skin;
  if (skin.folds.edges > 0 && skin.wrinkling_share > much_wrinkling) {
    equilibrium.doubts.push_back(message(
        "the skin is compressed enough to wrinkle over two elements or more on ",
        std::round(1000 * skin.wrinkling_share) / 10, " % of its area (wrinkles ",
        length_of_wrinkles(skin.longest_wrinkle_mm), "), and folds inwards at ", skin.folds.edges,
        skin.folds.edges == 1 ? " edge" : " edges", " of elements by up to ",
        std::round(skin.folds.sharpest_deg), " degrees: the folds depend on the mesh"));
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
  judge(equilibrium, scene);
  check_fields(scene, equilibrium);
}

}  // namespace breast
