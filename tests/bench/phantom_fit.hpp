// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of a phantom's breast size and tumour position to given displacements.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <nlopt.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "material/material_set.hpp"
#include "phantom/parameters.hpp"
#include "phantom/postures.hpp"
#include "phantom/random.hpp"

namespace breast {

/// Displacements (mm) of nipple and tumour from the prone shape to the supine and to the
/// stress-free shape.
struct LandmarkMotion {
  double nipple_supine = 0, tumour_supine = 0, nipple_free = 0, tumour_free = 0;
};

/// A fitted parameter and its bounds.
struct FittedParameter {
  std::string name;
  double low = 0, high = 0;
};
/// size (factor on kind_breast's radius, height and shoulder), tumour_aside (BreastParameters) and
/// tumour_level (0.5 to 0.7: in front of the mammograms' posterior edge).
inline const std::array<FittedParameter, 3>& fitted_parameters() {
  static const std::array<FittedParameter, 3> list{
      {{"size", 0.7, 1.3}, {"tumour_aside", 0.1, 0.75}, {"tumour_level", 0.5, 0.7}}};
  return list;
}

struct Calibration {
  double size = 1;          ///< factor on kind_breast's radius, height and shoulder (resized())
  double tumour_aside = 0;  ///< BreastParameters::tumour_aside
  double tumour_level = 0;  ///< BreastParameters::tumour_level
  LandmarkMotion motion;    ///< of the phantom found
  double misfit_mm = 0;     ///< root mean square over the four motions
  int evaluations = 0;

  /// Messages for parameters that ended on one of their bounds, such as "tumour_level 0.5 lies on
  /// its bound (0.5 to 0.7)": the best fit may lie beyond, and the other parameters compensate for
  /// it.
  std::vector<std::string> on_bounds() const {
    constexpr double near = 2e-3;  // twice the resolution of the search
    const std::array values = {size, tumour_aside, tumour_level};
    std::vector<std::string> list;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const FittedParameter& p = fitted_parameters()[k];
      if (values[k] - p.low > near && p.high - values[k] > near) continue;
      list.push_back(message(p.name, " ", values[k], " lies on its bound (", p.low, " to ", p.high,
                             "): the best fit may lie beyond it"));
    }
    return list;
  }
};

/// Displacements of the landmarks of one side, solved on the phantom's template with `mesh`
/// elements.
inline LandmarkMotion landmark_motion(const PhantomParameters& parameters, Side side,
                                      const MaterialSet& materials) {
  const Torso torso(parameters.torso, mix(parameters.seed, 301));
  PhantomBreast breast(parameters, torso, side);
  const HexMesh& mesh = breast.mesh;
  const Postures postures = solve_postures(breast.mesh, materials);
  const auto moved = [&](const char* name, const std::vector<Vec3>& to) {
    const Landmark& landmark = *mesh.landmark(name);
    return (landmark_position(mesh, to, landmark) - landmark_position(mesh, mesh.points, landmark))
        .norm();
  };
  return {moved("nipple", postures.supine), moved("tumour", postures.supine),
          moved("nipple", mesh.reference), moved("tumour", mesh.reference)};
}

/// Root mean square of the differences of the four motions, mm.
inline double misfit(const LandmarkMotion& a, const LandmarkMotion& b) {
  const double differences[] = {a.nipple_supine - b.nipple_supine,
                                a.tumour_supine - b.tumour_supine, a.nipple_free - b.nipple_free,
                                a.tumour_free - b.tumour_free};
  double sum = 0;
  for (const double d : differences) sum += d * d;
  return std::sqrt(sum / 4);
}

/// Least squares of the four motions by NLopt's BOBYQA (Powell 2009) over fitted_parameters(),
/// on a mesh of `mesh` elements. Deterministic. Throws Error (not converged) when a trial
/// breast has no equilibrium.
inline Calibration calibrate(const std::string& preset, std::uint64_t seed, Side side,
                             const LandmarkMotion& wanted, const MaterialSet& materials,
                             const MeshParameters& mesh, int max_evaluations, Progress& progress) {
  const BreastParameters base = kind_breast(preset);
  Calibration best;
  best.misfit_mm = HUGE_VAL;
  int evaluations = 0;
  const nlopt::vfunc objective = [](const std::vector<double>& x, std::vector<double>&,
                                    void* data) {
    return (*static_cast<std::function<double(const std::vector<double>&)>*>(data))(x);
  };
  std::function<double(const std::vector<double>&)> at = [&](const std::vector<double>& x) {
    BreastParameters breast = resized(base, x[0]);
    breast.tumour_aside = x[1], breast.tumour_level = x[2];
    PhantomParameters parameters = phantom_preset(preset, seed, breast);
    parameters.mesh = mesh;
    const LandmarkMotion motion = landmark_motion(parameters, side, materials);
    const double rms = misfit(motion, wanted);
    ++evaluations;
    if (rms < best.misfit_mm) best = {x[0], x[1], x[2], motion, rms, 0};
    progress.update(
        "calibrate", double(evaluations) / max_evaluations,
        message("size ", x[0], ", tumour aside ", x[1], ", level ", x[2], ", misfit ", rms, " mm"));
    return rms * rms;
  };
  nlopt::opt optimiser(nlopt::LN_BOBYQA, 3);
  optimiser.set_min_objective(objective, &at);
  std::vector<double> low, high;
  for (const FittedParameter& parameter : fitted_parameters()) {
    low.push_back(parameter.low);
    high.push_back(parameter.high);
  }
  optimiser.set_lower_bounds(low);
  optimiser.set_upper_bounds(high);
  optimiser.set_initial_step({0.05, 0.1, 0.05});
  optimiser.set_xtol_abs({1e-3, 1e-3, 1e-3});
  optimiser.set_maxeval(max_evaluations);
  std::vector<double> x{1, base.tumour_aside, base.tumour_level};
  double value = 0;
  optimiser.optimize(x, value);
  best.evaluations = evaluations;
  return best;
}

}  // namespace breast
