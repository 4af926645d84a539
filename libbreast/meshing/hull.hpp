// SPDX-License-Identifier: GPL-3.0-or-later
// The smooth surfaces and curves on which boundary nodes lie: sheets, cut, and the two rims.
#pragma once

#include <vector>

#include "meshing/body_map.hpp"
#include "meshing/place.hpp"

namespace breast {

/// Skin, wall and cut are surfaces; the rims are the curves where the cut meets skin and wall.
enum class Hull : std::uint8_t { skin, wall, cut, skin_rim, wall_rim };

/// A point of a hull part: sheets (s,t); cut and rims (u, height).
struct HullPoint {
  Vec2 at;
  Vec3 x;  ///< mm
};

/// The point of the part at these parameters.
HullPoint hull_point(const BodyMap& body, Hull part, const Vec2& at);
/// Position of a boundary node of the template on the part.
HullPoint hull_point_of_node(const BodyMap& body, Hull part, const PlacedNodes& nodes, int node);
/// Weighted mean of parameters, where u is averaged along the shorter way around the rim.
Vec2 mean_parameters(Hull part, const std::vector<Vec2>& at, const std::vector<double>& weights);
/// The point of the part that is nearest to `x`, by Gauss-Newton from `start`, which must be close
/// (half a face away).
HullPoint nearest_on_hull(const BodyMap& body, Hull part, const Vec2& start, const Vec3& x);

}  // namespace breast
