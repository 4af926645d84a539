// SPDX-License-Identifier: GPL-3.0-or-later
// Uncertainty of the chest wall's position, in mm.
#pragma once

#include "segment/wall/chest_wall.hpp"

namespace breast {

/// Standard deviation (mm) of every column's depth about the wall found: depths within 12 mm count
/// with the weight exp(-cost/0.1) of the column's own cost, the neighbours held; never below a
/// voxel's own sqrt(1/12). Smoothed over 8 mm. Manually corrected columns (confidence 1) are
/// treated separately by hand_set_sigma().
HeightField wall_sigma(const Volume<float>& ratio, const WallDomain& domain, const ChestWall& wall);

/// Where `after` differs from `before` by more than a quarter of a millimetre the wall was
/// corrected manually: sigma is limited to 1 mm there.
void hand_set_sigma(ChestWall& after, const HeightField& before);

/// Moves the whole wall backwards by `sigmas` standard deviations (forwards when negative), at most
/// to 3 mm below the skin.
void shift_wall(ChestWall& wall, const WallDomain& domain, double sigmas);

}  // namespace breast
