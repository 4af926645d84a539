// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of a phantom's breast size and tumour position to given displacements.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "material/material_set.hpp"
#include "phantom/parameters.hpp"

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
const std::array<FittedParameter, 3>& fitted_parameters();

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
  std::vector<std::string> on_bounds() const;
};

/// Displacements of the landmarks of one side, solved on the phantom's template with `mesh`
/// elements.
LandmarkMotion landmark_motion(const PhantomParameters& parameters, Side side,
                               const MaterialSet& materials);

/// Least squares of the four motions by NLopt's BOBYQA (Powell 2009) over fitted_parameters(),
/// on a mesh of `mesh` elements. Deterministic. Throws Error (not converged) when a trial
/// breast has no equilibrium.
Calibration calibrate(const std::string& preset, std::uint64_t seed, Side side,
                      const LandmarkMotion& wanted, const MaterialSet& materials,
                      const MeshParameters& mesh, int max_evaluations,
                      Progress& progress = no_progress());

}  // namespace breast
