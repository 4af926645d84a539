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
/// Surface of all elements of one tissue, without what lies on the body's boundary.
Facets tissue_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal, Tissue tissue);

/// A plate with its rounded edge and the bevel behind it, as contact has them: flat from the edge
/// `length` mm forward, `half_width` mm to either side of its origin.
Facets plate_facets(const PlateRecord& plate, double length, double half_width);

/// The sheet sampled on a grid of `fineness` cells per patch; `inside` are cells within the rim.
struct SheetFacets {
  Facets inside, outside;
  std::vector<std::vector<Vec3>> patch_lines;  ///< within the rim
  std::vector<Vec3> rim;                       ///< closed
};
SheetFacets sheet_facets(const HermiteSheet& sheet, const std::vector<Vec2>& rim, int fineness);

}  // namespace breast
