// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of the chest wall and the rib cage around it, as the surface on which a breast slides.
#pragma once

#include "fit/wall/wall_sheet.hpp"
#include "image/label_volume.hpp"
#include "surface/hermite.hpp"

namespace breast {

struct ThoraxReport {
  /// Half axes of the ellipse into which the surface blends where there are no data.
  double half_width_mm = 0, half_depth_mm = 0;
  std::size_t wall_points = 0;               ///< number of wall data beside the breast
  double wall_mean_mm = 0, wall_p95_mm = 0;  ///< distances of these data from the surface
  double sheet_max_mm = 0;                   ///< largest distance of the wall sheet within the rim
};

/// Fits a surface that coincides with the wall sheet within the rim (to a fraction of a
/// millimetre), follows the labels' chest wall beside the breast with reduced weight of outliers,
/// and beyond these data blends into an elliptic cylinder fitted to them. It extends `reach` (150
/// mm) beyond the breast. The centre of the ellipse lies near `midline` (x, mm) if the labels
/// contain it.
ThoraxSurface fit_thorax(const LabelVolume& labels, const BreastGeometry& geometry,
                         ThoraxReport& report);

}  // namespace breast
