// SPDX-License-Identifier: GPL-3.0-or-later
// The skin in front of a box as a triangle mesh with the topology of a disc.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"
#include "fit/occupancy.hpp"

namespace breast {

struct DiscSurface {
  std::vector<Vec3> points;                   ///< mm, on the skin (field value 1/2)
  std::vector<Vec3> normals;                  ///< unit, out of the body
  std::vector<double> areas;                  ///< mm^2 that belong to each point
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<int> border;                    ///< one loop, surface on its left seen from outside
  std::vector<char> filled;  ///< 1 where a hole in the skin (field of view) was closed by a fan
};

/// Marching tetrahedra with `step_mm` on the field in `box`, after filling cavities that are not
/// open to the air in front and removing parts that are not connected to the breast; the triangles
/// are equalised along the surface. Throws Error (input) if the skin at `nipple` does not have the
/// topology of a disc.
DiscSurface extract_skin(const OccupancyField& field, const Box& box, const Vec3& nipple,
                         double step_mm);

}  // namespace breast
