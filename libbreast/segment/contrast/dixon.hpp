// SPDX-License-Identifier: GPL-3.0-or-later
// Dixon scans: water and fat as two images.
#pragma once

#include <string>

#include "segment/work.hpp"

namespace breast {

/// The sum of both, in which fat is bright as in a T1-weighted scan in phase and which does not care
/// where the two are exchanged, and fat's share of it.
struct Dixon {
  Volume<float> sum, fat_share;
};
/// Throws Error (input) if the two are not on one grid.
Dixon dixon_images(const Volume<float>& water, const Volume<float>& fat);

/// Brightness of a scan with the contrast of fat's share: 1 in fat, 0 outside the body.
struct FatShare {
  Volume<float> ratio;
  double muscle = 0;     ///< ratio behind the wall
  double scatter = 0;    ///< coefficient of variation in fat
  double exchanged = 0;  ///< share of the breast in which water and fat are exchanged
};
/// Scanners exchange water and fat in whole regions, where their phase is ambiguous. There, fat's
/// share contradicts the sum, in which fat is bright: it is turned over. Where both contradict each
/// other voxel by voxel, at the border of such a region, the sum alone counts. Throws Error (input)
/// if fat's share does not separate fat from muscle.
FatShare fat_share_of(const Work& work);

}  // namespace breast
