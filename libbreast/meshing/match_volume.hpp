// SPDX-License-Identifier: GPL-3.0-or-later
// Volume correction of a mesh: flat faces on a curved skin lose volume; a shift of the skin nodes
// restores the volume and hence the weight.
#pragma once

#include "meshing/place.hpp"

namespace breast {

/// Shifts skin nodes (not the rim) along the sheet's normal, in proportion to the gap between the
/// sheet and the adjacent faces, so that the mesh has the volume `wanted` (mm³). Only the part of
/// the difference caused by the skin is corrected: the factor is at most the two thirds needed for
/// a paraboloid, and the volume lost at the polygonal rim is not restored. Returns the largest
/// shift in mm.
double match_volume(double wanted, const BodyMap& body, const DomeTemplate& dome,
                    const std::vector<bool>& held, PlacedNodes& nodes);

}  // namespace breast
