// SPDX-License-Identifier: GPL-3.0-or-later
// The borders of the breast at which the faces of the cut lie.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"
#include "surface/rim_border.hpp"

namespace breast {

/// Per face of the cut, that of the nearest place of the rim in the imaged shape: sternum, clavicle,
/// axilla or inframammary fold. Faces beyond the breast (surroundings) have that of the rim inside them.
/// Empty if the mesh has no geometry.
std::vector<RimBorder> cut_borders(const HexMesh& mesh);

}  // namespace breast
