// SPDX-License-Identifier: GPL-3.0-or-later
// The rim at which the body ends: a closed curve in the parameters of each sheet, joined by a
// straight cut.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "fit/rim_rays.hpp"
#include "fit/wall/wall_sheet.hpp"
#include "surface/hermite.hpp"
#include "surface/margin.hpp"

namespace breast {

struct Rim {
  Vec2 centre;
  std::vector<Vec2> skin, wall;
  std::vector<RimEnd> end;
  /// Distances along the skin from the border of the labelled breast to the rim, positive outwards:
  /// smallest, median and largest, where the labels end within the sheet.
  double beyond_labels_min_mm = 0, beyond_labels_median_mm = 0, beyond_labels_max_mm = 0;
  Vec3 farthest_beyond{0, 0, 0};  ///< patient mm, where the largest of them is
  double wider_mm = 0;            ///< by which all of the rim was moved outwards to lay the cut
  double greatest_thickness_mm = 0;
  double cut_height_min_mm = 0, cut_height_median_mm = 0, cut_height_max_mm = 0;
  /// Interior angles between cut and skin and between cut and wall, degrees.
  double skin_angle_min = 0, skin_angle_median = 0, skin_angle_max = 0;
  double wall_angle_min = 0, wall_angle_median = 0, wall_angle_max = 0;
};

/// The rim through the ends of the rays, low-passed. The directions of the cut lie halfway between the
/// closest wall point and +y, and are smoothed until no segments cross and the rim of the wall is
/// star-shaped. Where no such cut exists, the rim is smoothed more, and then moved outwards or inwards
/// by up to 12 mm. Throws Error (input), with the place, if no such rim exists.
Rim lay_rim(const HermiteSheet& skin, const WallSheet& wall, const RimRays& rays,
            const SheetMargin& margin);

/// True if the angle of the polygon about `centre` increases from each point to the next and makes
/// one turn.
bool star_shaped(const std::vector<Vec2>& curve, const Vec2& centre);
Vec2 centroid(const std::vector<Vec2>& curve);
/// True inside a curve that is star-shaped about `centre`.
bool inside_star(const std::vector<Vec2>& curve, const Vec2& centre, const Vec2& st);

}  // namespace breast
