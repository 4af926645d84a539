// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of the nipple.
#pragma once

#include "core/units.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {

struct Nipple {
  Vec3 tip{0, 0, 0};        ///< patient mm, on the skin
  Vec3 base{0, 0, 0};       ///< patient mm: where the papilla's axis meets the areola's surface
  double height = 0;        ///< mm from base to tip; 0 on a smooth dome
  double from_extreme = 0;  ///< mm between the tip and the most anterior point of the breast
  Vec3 extreme{0, 0, 0};    ///< patient mm: that point
};
/// Starts from the most convex skin point (least body within 6 mm, by a Gaussian): for a prone scan
/// within 25 mm of the most anterior point, for a supine scan anywhere on the breast more than 15
/// mm from its end. Around it, the height of the skin over its tangent plane is compared with a
/// quadric through the ring 9-25 mm away. The part that protrudes by more than half the maximum is
/// the papilla (or the apex of a cone), and its weighted centre is the nipple, to a fraction of a
/// voxel.
Nipple find_nipple(const Mask& breast, const Mask& body, Posture posture = Posture::prone);

}  // namespace breast
