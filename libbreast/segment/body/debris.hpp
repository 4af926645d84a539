// SPDX-License-Identifier: GPL-3.0-or-later
// Removal of structures on the skin that do not belong to the breast: markers, creams, small folds.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Removes from the body structures that protrude from the skin by more than 2 mm and are so thin that a
/// morphological opening of the axial slices (disc of 3.5 mm) erases them, except near the most anterior
/// point of each half (the nipples, which look similar). Returns the removed volume, ml. `midline` is the column
/// between the halves.
double remove_debris(Mask& body, int midline);

/// Removes from the body what is dim and farther than 1.5 mm from all that its skin and fat enclose: haze of the air in front of
/// it and beside it. Dim is less than 0.07 of the brightest tissue within about 75 mm. The interior of the chest is enclosed.
void remove_haze(Mask& body, const Volume<float>& scan);

/// Removes from the body, from its border inwards by at most 25 mm, voxels dimmer than 0.15 of the
/// brightest tissue within 15 mm: ghosts of the heart beside the body that exceed the threshold.
/// Skin is brighter than that; the dark interior of the chest is filled in again afterwards.
void remove_ghosts(Mask& body, const Volume<float>& scan);

}  // namespace breast
