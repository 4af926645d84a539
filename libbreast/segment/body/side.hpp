// SPDX-License-Identifier: GPL-3.0-or-later
// Check that the requested breast is the one in the field of view.
#pragma once

#include "segment/body/body.hpp"

namespace breast {

/// Where one breast alone is in view, mm by which the skin falls back farther on the patient's left
/// of its tip than on the right: medial of a breast lies the sternum, lateral of it the flank, far
/// behind. Positive for a left breast.
double fall_to_the_left(const TorsoFront& torso, const Grid& grid);

/// Throws Error (input) when the one breast in view is clearly the other one, or when the most
/// anterior skin of the side lies where the field of view ends, its breast being beyond.
void refuse_other_side(const TorsoFront& torso, const Grid& grid, Side side);

}  // namespace breast
