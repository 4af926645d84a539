// SPDX-License-Identifier: GPL-3.0-or-later
// A surface joined from its parts, with one node per position, and the lines between the parts.
#pragma once

#include "surface/tri_mesh.hpp"

namespace breast {

struct WeldedSurface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> part;                ///< per triangle
  std::vector<std::vector<int>> seams;  ///< closed lines between two parts, first node repeated
};

/// Joins points with exactly the same position. Throws Error (input) unless every edge belongs to
/// two triangles that traverse it in opposite directions.
WeldedSurface weld(const TriMesh& surface);

}  // namespace breast
