// SPDX-License-Identifier: GPL-3.0-or-later
// The rim at which the body ends: a closed curve in the parameters of each sheet, joined by a
// straight cut.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "fit/wall/wall_sheet.hpp"
#include "surface/hermite.hpp"
#include "surface/margin.hpp"

namespace breast {

struct RimOptions {
  int rays = 96;
  double least_thickness_mm =
      0;  ///< tissue where the body ends; 0: sternal tissue + 5, within 15..30
  /// Slope below which the tissue may end, if it is also thinner than slope_below.
  double slope_degrees = 15;
  double slope_below = 0.4;  ///< thickness for this, as a fraction of the greatest thickness
  /// Beyond the least thickness the rim continues outwards until the angle between skin and wall is
  /// below `steep_degrees`, or the tissue is thinner than `steep_down_to` of it: a rim on the steep
  /// side of the breast would give elements with an angle of nearly 180 degrees between skin and
  /// cut.
  double steep_degrees = 40;
  double steep_down_to = 0.6;
  double low_pass_degrees = 12;  ///< standard deviation of the smoothing of the rim's log radius
  SheetMargin margin;
};

struct Rim {
  Vec2 centre;
  std::vector<Vec2> skin, wall;
  std::vector<RimEnd> end;
  /// Distance by which the rim was moved outwards to obtain the volume.
  double wider_mm = 0;
  double least_thickness_mm = 0;  ///< thickness that was used
  double greatest_thickness_mm = 0;
  double cut_height_min_mm = 0, cut_height_median_mm = 0, cut_height_max_mm = 0;
  /// Interior angles between cut and skin and between cut and wall, degrees.
  double skin_angle_min = 0, skin_angle_median = 0, skin_angle_max = 0;
  double wall_angle_min = 0, wall_angle_median = 0, wall_angle_max = 0;
};

/// The ends of rays from the centre of the thick part (see RimOptions).
struct RimRays {
  Vec2 centre;
  std::vector<Vec2> direction;  ///< unit, in the skin's parameters
  std::vector<double> radius;
  std::vector<RimEnd> end;
  double least_thickness_mm = 0, greatest_thickness_mm = 0;
};
/// Follows rays from the centre of the thick part outwards. Throws Error (input) if no part is
/// thick enough.
RimRays walk_rim(const HermiteSheet& skin, const WallSheet& wall, Side side, const Vec2& nipple_st,
                 const RimOptions& options);

/// The rim through the ends of the rays, low-passed and moved outwards along the skin by `wider_mm`
/// (not beyond the margin). The directions of the cut lie halfway between the closest wall point
/// and +y, and are smoothed until no segments cross and the rim of the wall is star-shaped. Throws
/// Error (input) if no such rim exists.
Rim lay_rim(const HermiteSheet& skin, const WallSheet& wall, const RimRays& rays, double wider_mm,
            const RimOptions& options);

/// True if the angle of the polygon about `centre` increases from each point to the next and makes
/// one turn.
bool star_shaped(const std::vector<Vec2>& curve, const Vec2& centre);
Vec2 centroid(const std::vector<Vec2>& curve);
/// True inside a curve that is star-shaped about `centre`.
bool inside_star(const std::vector<Vec2>& curve, const Vec2& centre, const Vec2& st);

}  // namespace breast
