// SPDX-License-Identifier: GPL-3.0-or-later
// The chest wall as a Hermite sheet that is a height y over (x,z).
#pragma once

#include "core/types.hpp"
#include "fit/occupancy.hpp"
#include "image/label_volume.hpp"
#include "surface/hermite.hpp"

namespace breast {

/// s runs linearly with x, t with z, so x_s × x_t points to the front (-y): out of the chest wall,
/// into the breast. Beyond the data the sheet is extrapolated linearly (least bending).
struct WallSheet {
  HermiteSheet sheet;
  Box box;              ///< x and z range of the sheet; y range of its data
  double coverage = 0;  ///< part of the columns behind the breast that show the wall
  double rms_mm = 0;    ///< robust distance of the data within the breast's foot
  double residual_p95_mm = 0;

  Vec2 parameter(const Vec3& p) const {
    return {(p.x() - box.low.x()) / (box.high.x() - box.low.x()),
            (p.z() - box.low.z()) / (box.high.z() - box.low.z())};
  }
  /// Distance in front of the wall along y, mm (negative behind).
  double height_above(const Vec3& p) const { return sheet.position(parameter(p)).y() - p.y(); }
};

/// Fits the sheet to the first muscle from the front in every column of a 3 mm raster, smoothed
/// over `smoothing_mm`, weighted by the chest wall's confidence and with reduced weight of
/// outliers. Throws Error (input) when less than a fifth of the columns behind the breast show
/// muscle.
WallSheet fit_wall(const LabelVolume& labels, const BreastRegion& region, int nu, int nv,
                   double smoothing_mm);

}  // namespace breast
