// SPDX-License-Identifier: GPL-3.0-or-later
// Plausibility checks of a scan and its segmentation, and the messages for the user.
#pragma once

#include <string>
#include <vector>

#include "segment/work.hpp"

namespace breast {

/// Cross-section of the breast on the border of the scan's voxels, cm2.
double cut_by_view_cm2(const Mask& breast, const Mask& seen);

/// Area of skin (cm2) around which, within 10 mm, both principal radii exceed 250 mm, more than 30
/// mm in front of the wall. A freely hanging breast has none; one that rests on the coil or the
/// table has some.
double flat_skin_cm2(const Work& work);

/// Extents that are within limits for every adult breast.
struct Extents {
  /// Of what lies in front of the skin over the sternum on this side, in the slices that show the breast: the share that is not
  /// labelled breast.
  double front_left_out_percent = 0;
  double lateral_border_mm = 0;   ///< farthest column on the wall from the midline
  double nipple_depth_mm = 0;     ///< from the nipple back to the wall
  double nipple_in_front_mm = 0;  ///< distance of the nipple in front of the skin over the sternum
  /// How far the view goes on behind the skin over the sternum, or the wall is sought, where the breast reaches farthest
  /// aside: median of its slices. A view that ends before the ribs turn to the side cuts the breast there.
  double view_behind_sternum_mm = 0;
  double volume_ml = 0;
};
Extents extents_of(const Work& work, const Vec3& nipple, Side side);
/// One sentence for each extent that is outside the range observed in patients.
std::vector<std::string> extent_doubts(const Extents& found, double greatest_depth_mm);

}  // namespace breast
