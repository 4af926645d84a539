// SPDX-License-Identifier: GPL-3.0-or-later
// Check that the requested breast is the one in the field of view.
#pragma once

#include "segment/body/body.hpp"

namespace breast {

/// If only one breast is in view: the distance (mm) by which the skin recedes farther on the
/// patient's left side of its tip than on the right. Medial to a breast lies the sternum, and
/// lateral to it the flank, much farther behind; the distance is therefore positive for a left
/// breast.
double fall_to_the_left(const TorsoFront& torso, const Grid& grid);

/// Throws Error (input) if the only breast in view is clearly the other one, or if the most
/// anterior skin of the side lies at the border of the field of view, so that the breast is outside
/// it.
void refuse_other_side(const TorsoFront& torso, const Grid& grid, Side side);

}  // namespace breast
