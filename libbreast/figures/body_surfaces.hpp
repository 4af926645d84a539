// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of a breast mesh for drawing: skin, chest wall, cut, fibroglandular region, plates.
#pragma once

#include <vector>

#include "figures/canvas.hpp"
#include "mesh/hex_mesh.hpp"
#include "surface/hermite.hpp"

namespace breast {

/// Faces in a nodal field; a 9-node face becomes four quadrilaterals.
Facets face_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal,
                   const std::vector<Face>& faces);
/// Surface of all elements of one tissue, without the faces on the boundary of the body.
Facets tissue_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal, Tissue tissue);

/// A plate with its rounded edge and the wall behind it, in the geometry of the contact: the flat
/// part extends from the edge by `length` mm forwards and by `half_width` mm to either side of its
/// origin.
Facets plate_facets(const PlateRecord& plate, double length, double half_width);

/// The sheet sampled on a grid of `fineness` cells per patch; `inside` are cells within the rim.
struct SheetFacets {
  Facets inside, outside;
  std::vector<std::vector<Vec3>> patch_lines;  ///< within the rim
  std::vector<Vec3> rim;                       ///< closed
};
SheetFacets sheet_facets(const HermiteSheet& sheet, const std::vector<Vec2>& rim, int fineness);

}  // namespace breast
