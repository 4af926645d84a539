// SPDX-License-Identifier: GPL-3.0-or-later
// The fibroglandular region as one smooth surface, from the elements' volume fractions.
#pragma once

#include "figures/canvas.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// The surface on which the continuous fraction (means at the nodes of the elements' fractions) has
/// the one value that encloses as much volume of the scan as the fractions sum to. It is found in
/// the elements' own coordinates and carried by the element map, so that it is the same tissue in
/// every nodal field. A mesh without fractions has 1 in its fibroglandular elements and 0 elsewhere.
/// Empty for a mesh without fibroglandular tissue.
Facets gland_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal);
/// mm3 of fibroglandular tissue in the scan's shape: the elements' volumes times their fractions.
double gland_volume(const HexMesh& mesh);

}  // namespace breast
