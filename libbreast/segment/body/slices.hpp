// SPDX-License-Identifier: GPL-3.0-or-later
// Morphology in the axial slices of a mask, with discs of at least one voxel.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Takes away what a disc of this radius (mm) does not fit into.
void open_slices(Mask& mask, double radius);

/// What open_slices would take away; `height` becomes how far each voxel stands out of what is left (mm). Slices of which nothing
/// would be left have neither.
Mask opening_residue(const Mask& mask, double radius, Volume<float>& height);

/// Adds gaps that a disc of this radius (mm) does not fit into, as if each slice continued beyond its border.
void close_slices(Mask& mask, double radius);

/// Takes away what is nearer to the border of the mask than this radius (mm), as if each slice continued beyond its own border.
void erode_slices(Mask& mask, double radius);

/// Adds everything that air cannot reach from the front row of each slice.
void fill_slices_from_front(Mask& mask);

}  // namespace breast
