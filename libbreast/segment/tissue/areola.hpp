// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of the areola by its skin, for breasts whose nipple does not stand out.
#pragma once

#include "core/units.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {

struct Areola {
  bool found = false;
  Vec3 centre{0, 0, 0};  ///< patient mm, on the skin
  double excess = 0;     ///< mm of missing fat, more than on the median of the skin
  double elsewhere = 0;  ///< the greatest excess farther away than an areola reaches, mm
  double behind = 0;     ///< mean brightness behind the skin there, of fat
};
/// Where the skin of a prone breast's front is thickest or darkest. At every point of the skin, the
/// brightness that is missing in its outermost 5 mm is integrated along the normal, and averaged
/// with a Gaussian of 9 mm, about the width of an areola, whose skin is thicker. `found`: within
/// 60 mm of `front` (patient mm), the greatest mean exceeds the median of the skin by at least
/// 0.5 mm, no place 34 mm away from it has more than 0.6 of its excess, and the 5 mm behind have
/// at least 0.7 of the brightness of fat: gland that touches the skin cannot be told from an areola.
/// Nothing is found in voxels longer than 3 mm.
///
/// `brightness` and `skin_distance` are those of skin_thickness(): fat is 1, and bright.
Areola find_areola(const Volume<float>& brightness, const Mask& breast, const Mask& body,
                   const Volume<float>& skin_distance, const Vec3& front);

}  // namespace breast
