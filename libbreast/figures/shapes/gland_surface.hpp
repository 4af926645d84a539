// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of the fibroglandular region as one smooth surface, from the volume fractions of the
// elements.
#pragma once

#include "figures/canvas.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// The surface on which the continuous fraction (nodal means of the elements' fractions) has the
/// value that encloses, in the scan, as much volume as the fractions sum to. It is computed in
/// local coordinates of the elements and moved by the element map, so that it encloses the same
/// tissue in every nodal field. A mesh without fractions has 1 in its fibroglandular elements and 0
/// elsewhere. Empty for a mesh without fibroglandular tissue.
Facets gland_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal);
/// Volume of fibroglandular tissue in the shape of the scan, mm³: the volumes of the elements times
/// their fractions.
double gland_volume(const HexMesh& mesh);

}  // namespace breast
