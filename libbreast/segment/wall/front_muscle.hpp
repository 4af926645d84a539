// SPDX-License-Identifier: GPL-3.0-or-later
// Muscle with fat in it that lies on the chest wall: serratus anterior and the border of pectoralis
// major and latissimus dorsi.
#pragma once

#include <vector>

#include "segment/wall/chest_wall.hpp"
#include "segment/wall/extent.hpp"

namespace breast {

/// Moves the wall to the front of muscle that lies on it. The strongest edge behind a breast is that
/// of ribs and intercostal muscle. Muscle in front of it has fat between its strands: it is darker
/// than the fat of the breast but brighter than what lies behind it, and its brightness is that of
/// fibroglandular tissue. It is told from that by where it lies: in a layer at most 25 mm thick that
/// touches the wall and runs on to the side beyond the breast, to the end of the body or of the
/// field of view. The layer is the least cost of darkness of the tissue in it and of steps of its
/// thickness from column to column (minimum cut). Below and above the breast, where muscle of the
/// belly and of the shoulder has other shapes, the wall stays: only the slices of `extent` are
/// searched. `ratio` is intensity / bias. With `skin_distance` (mm, negative in the body; may be
/// null) the layer does not reach into slices that run along the lower or upper skin of the breast,
/// which is as dark: where the body ends in the next slice. The layer does not reach in front of
/// `sternal_skin`, the depth (mm) of the skin over the sternum in each slice: a prone breast hangs there, and
/// dense gland that lies on the wall would be taken for muscle. Returns the volume that was moved behind
/// the wall, ml.
double include_front_muscle(ChestWall& wall, const Volume<float>& ratio,
                            const Volume<float>* skin_distance, const WallDomain& domain,
                            const BreastExtent& extent, const std::vector<double>& sternal_skin);

}  // namespace breast
