// The size of a phantom's breast and the place of its tumour that give wanted displacements.
#pragma once

#include "core/progress.hpp"
#include "material/law.hpp"
#include "phantom/parameters.hpp"

namespace breast {

/// How far (mm) nipple and tumour move from the prone shape: to supine, and to stress-free.
struct LandmarkMotion {
  double nipple_supine = 0, tumour_supine = 0, nipple_free = 0, tumour_free = 0;
};

struct Calibration {
  double size = 1;          ///< factor on kind_breast's radius, height and shoulder (resized())
  double tumour_aside = 0;  ///< BreastParameters::tumour_aside
  double tumour_level = 0;  ///< BreastParameters::tumour_level
  LandmarkMotion motion;    ///< of the phantom found
  double misfit_mm = 0;     ///< root mean square over the four motions
  int evaluations = 0;
};

/// How the landmarks of one side move, solved on the phantom's template with `mesh` elements.
LandmarkMotion landmark_motion(const PhantomParameters& parameters, Side side,
                               const MaterialSet& materials);

/// Least squares of the four motions by NLopt's BOBYQA (Powell 2009) over size (0.7–1.3) and the
/// tumour's distance from the axis (0.1–0.75) and level (0.5–0.7: in front of the mammograms'
/// posterior edge), on a mesh of `mesh` elements. Deterministic. Throws
/// Error (not converged) when a trial breast has no equilibrium.
Calibration calibrate(const std::string& preset, std::uint64_t seed, Side side,
                      const LandmarkMotion& wanted, const MaterialSet& materials,
                      const MeshParameters& mesh, int max_evaluations,
                      Progress& progress = no_progress());

}  // namespace breast
