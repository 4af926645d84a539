// SPDX-License-Identifier: GPL-3.0-or-later
// Where a scan has data, and what stands in the place of data beyond.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// 1 where the scan has data; empty if it has data everywhere. A scan that was sampled again along
/// other axes is padded with one value, the darkest, around a convex polygon in every slice. Air
/// that a scanner has set to zero ends at the skin, which makes no such polygon.
Mask voxels_with_data(const Volume<float>& scan);
/// Without data a voxel gets the value of the nearest voxel of its slice that has data: the border
/// of what was scanned is no edge of the body.
void continue_beyond_data(Volume<float>& scan, const Mask& seen);
/// Makes what lies before the first voxel with data of a column at most as bright as air: where a corner of
/// the view cuts the skin, the continued scan would be a body that reaches to the front. Nothing if all is seen.
void end_at_front(Volume<float>& scan, const Mask& seen);

}  // namespace breast
