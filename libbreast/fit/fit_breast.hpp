// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of the geometry of one breast to labels: skin sheet, chest-wall sheet, rim.
#pragma once

#include <string>
#include <vector>

#include "core/distances.hpp"
#include "core/progress.hpp"
#include "core/report.hpp"
#include "fit/rim.hpp"
#include "fit/wall/thorax_fit.hpp"
#include "image/label_volume.hpp"
#include "surface/hermite.hpp"

namespace breast {

struct FitOptions {
  int patches_s = 10, patches_t = 10;  ///< per sheet
  /// Smoothing of the skin sheet (see sheet_fit.hpp); 0: automatic.
  double smoothing = 0;
  double max_error_mm =
      0;  ///< if > 0, the skin sheet is refined until its largest distance is smaller
  double target_rms_mm = 0.3;
  /// Target for the largest distance: the smoothing is lowered, and up to most_patches per side are
  /// used, until no point of the skin lies farther from its sheet. Missing the target is a doubt,
  /// not an error.
  double target_max_mm = 2;
  int most_patches = 10;
  double margin_mm = 25;       ///< skin included beyond the base of the breast
  double surface_step_mm = 3;  ///< raster of the skin surface
  double wall_smoothing_mm = 7;
  RayOptions rays;
};

struct FitReport {
  double smoothing = 0, rms_mm = 0;
  int patches_s = 0, patches_t = 0, loops = 0;
  bool target_reached = false;
  std::size_t data_points = 0, filled_points = 0;
  double area_ratio_p95 = 0;      ///< of the map to the square
  Distances skin_to_sheet;        ///< data inside the rim
  Vec3 worst_point{0, 0, 0};      ///< patient mm: the datum farthest from the sheet
  Distances sheet_to_skin;        ///< sheet inside the rim
  Distances whole_skin_to_sheet;  ///< all data where the body may lie (rim margin)
  double min_normal_cosine = 0,
         min_area_ratio = 0;  ///< smallest values in the check of the skin sheet for folds
  double wall_rms_mm = 0, wall_p95_mm = 0, wall_coverage = 0;
  double nipple_moved_mm = 0;  ///< distance from the landmark to the skin sheet
  double body_ml = 0,
         label_ml = 0;  ///< volume inside sheets and cut, and volume of the labelled breast
  Rim rim;
  ThoraxReport thorax;
  std::vector<std::string> mended;  ///< what did not work at first and was done differently
  std::vector<std::string> doubts;  ///< results that the user should check
};

/// Fits sheets and rim. Throws Error (input) if the labels contain no breast that can be bounded in
/// this way, and Error (not_converged) if no sheet without folds was found or max_error_mm was not
/// met.
BreastGeometry fit_breast(const LabelVolume& labels, const FitOptions& options, FitReport& report,
                          Timer& timer, Progress& progress = no_progress());

/// Volume (mm^3) inside skin, wall and cut, by the divergence theorem on a polar raster.
double enclosed_volume(const BreastGeometry& geometry, int rings = 40);

/// Triangles of the body's closed boundary (skin, cut, wall) on the same
/// raster, for pictures and checks.
struct BoundaryMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> part;  ///< per triangle: 0 skin, 1 cut, 2 wall
};
BoundaryMesh boundary_mesh(const BreastGeometry& geometry, int rings = 40);

}  // namespace breast
