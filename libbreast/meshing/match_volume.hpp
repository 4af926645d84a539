// SPDX-License-Identifier: GPL-3.0-or-later
// Volume correction of a mesh: flat faces on a curved skin lose volume, and a shift of the skin
// nodes restores it and hence the weight.
#pragma once

#include "meshing/place.hpp"

namespace breast {

/// Shifts skin nodes (not the rim) along the sheet's normal in proportion to the gap between sheet
/// and faces round them, so that the mesh has the volume `wanted` (mm³), as far as the skin causes
/// the difference: the factor is at most the two thirds that a paraboloid needs, and the volume
/// lost by the polygonal rim is not recovered. Returns the largest shift in mm.
double match_volume(double wanted, const BodyMap& body, const DomeTemplate& dome,
                    const std::vector<bool>& held, PlacedNodes& nodes);

}  // namespace breast
