// SPDX-License-Identifier: GPL-3.0-or-later
// Uncertainty of the chest wall's position, in mm.
#pragma once

#include "segment/wall/chest_wall.hpp"

namespace breast {

/// Standard deviation (mm) of the depth in every column about the wall found. Depths within 12 mm
/// have the weight exp(-cost/0.1) with the column's own cost, for fixed neighbours, and with a
/// voxel's own sqrt(1/12). Their spread is multiplied by 1.8 - 1.45 times the confidence, at least
/// by 0.5, which is calibrated on true walls, and smoothed over 8 mm. Manually corrected columns
/// (confidence 1) are treated separately by hand_set_sigma().
HeightField wall_sigma(const Volume<float>& ratio, const WallDomain& domain, const ChestWall& wall);

/// Where `after` differs from `before` by more than a quarter of a millimetre the wall was
/// corrected manually: sigma is limited to 1 mm there.
void hand_set_sigma(ChestWall& after, const HeightField& before);

/// Moves the whole wall backwards by `sigmas` standard deviations (forwards when negative), at most
/// to 3 mm below the skin.
void shift_wall(ChestWall& wall, const WallDomain& domain, double sigmas);

}  // namespace breast
