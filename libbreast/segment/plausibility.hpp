// SPDX-License-Identifier: GPL-3.0-or-later
// Plausibility checks of a scan and its segmentation, and the messages for the user.
#pragma once

#include <string>
#include <vector>

#include "segment/work.hpp"

namespace breast {

/// Cross-section of the breast on the border of the scan's voxels, cm2.
double cut_by_view_cm2(const Mask& breast);

/// Skin around which, within 10 mm, both principal radii exceed 250 mm, more than 30 mm in front of
/// the wall: a breast hanging free has none; one that rests on coil or table has. cm2.
double flat_skin_cm2(const Work& work);

/// What an adult's breast cannot be far from, whatever its shape.
struct Extents {
  /// Of the body on this side in front of the sternum's skin: there is breast and nothing else.
  double front_left_out_percent = 0;
  double lateral_border_mm = 0;  ///< farthest column on the wall from the midline
  double nipple_depth_mm = 0;    ///< from the nipple back to the wall
  double volume_ml = 0;
};
Extents extents_of(const Work& work, const Vec3& nipple, Side side);
/// One sentence for each of them that is out of the range seen in patients.
std::vector<std::string> extent_doubts(const Extents& found, double greatest_depth_mm);

}  // namespace breast
