// SPDX-License-Identifier: GPL-3.0-or-later
// Extent of the breast within the body in front of the chest wall.
#pragma once

#include "core/types.hpp"
#include "segment/wall/chest_wall.hpp"

namespace breast {

struct BreastExtent {
  std::vector<std::uint8_t> columns;  ///< nx*nz: 1 where the breast covers the chest wall
  double sternal_thickness = 0;       ///< mm from wall to skin over the sternum
  double least_thickness = 0;         ///< mm; thickness at which the breast ends
  double greatest_thickness = 0;      ///< mm
};
/// `skin_distance` is the signed distance to air (mm, negative inside). A supine breast extends to
/// where the wall turns away from the front: tissue there in front of the deepest wall sought is
/// breast too.
BreastExtent find_extent(const ChestWall& wall, const WallDomain& domain, const TorsoFront& torso,
                         const Volume<float>& skin_distance, Side side,
                         Posture posture = Posture::prone);

/// Voxels of the breast: those in front of the wall in the columns of the extent, and overhanging
/// parts beyond it. In front of folds, and everywhere if the columns would cut off more than 8 %
/// of a prone breast, also the tissue whose nearest point of the wall the breast covers.
Mask breast_voxels(const Mask& body, const ChestWall& wall, const WallDomain& domain,
                   const TorsoFront& torso, const BreastExtent& extent, Side side,
                   Posture posture = Posture::prone);

}  // namespace breast
