// SPDX-License-Identifier: GPL-3.0-or-later
// Separation of fat and fibroglandular tissue inside the breast.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Method that separates fibroglandular tissue from fat.
enum class Interior {
  threshold,      ///< midway between the brightness of gland and fat
  region_growing  ///< the paper's 3-D confidence-connected growing of fat; what is left is gland
};

struct Fibroglandular {
  Volume<float> fraction;   ///< [0,1], 0 outside the interior; 0 or 1 by region growing
  Mask lobes;               ///< voxels labelled fibroglandular
  double threshold = 0;     ///< ratio below which a voxel counts as fibroglandular
  double gland_ratio = 0;   ///< brightness of gland relative to fat
  double fat_fraction = 0;  ///< of the interior, by threshold
  double fat_fraction_grown =
      0;                 ///< of the interior, by confidence-connected region growing of fat
  double agreement = 0;  ///< Dice of the fibroglandular voxels of both ways
};
/// `interior` is the breast beneath the skin and in front of the wall, in `body`. `ratio` is intensity / bias:
/// 1 in fat, with the coefficient of variation `fat_cv`. Dark components below 60 mm3, or mostly in
/// `by_muscle`, stay fat in the labels. A fraction is the mixture of gland and fat that has the
/// brightness of the voxel. In and next to dark components, the fractions are adjusted so that
/// limiting them to 0 and 1 does not change their sum; elsewhere only brightness beyond the scatter
/// of fat counts. Throws Error (input) if region growing is requested and finds no fat to start
/// from.
Fibroglandular find_fibroglandular(const Volume<float>& ratio, const Mask& body,
                                   const Mask& interior, const Mask& by_muscle, double muscle_ratio,
                                   double fat_cv, Interior interior_by);

}  // namespace breast
