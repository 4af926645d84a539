// SPDX-License-Identifier: GPL-3.0-or-later
// Where the breast ends on its skin: the border of the labelled breast, followed along rays.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "fit/occupancy.hpp"
#include "fit/wall/wall_sheet.hpp"
#include "image/label_volume.hpp"
#include "surface/hermite.hpp"
#include "surface/margin.hpp"

namespace breast {

struct RayOptions {
  int rays = 96;
  /// Beyond the border of the labels the rim continues outwards until the angle between skin and wall
  /// is below `steep_degrees`, by at most `farthest_mm` along the skin: a rim on the steep side of the
  /// breast would give elements with an angle of nearly 180 degrees between skin and cut.
  double steep_degrees = 40, farthest_mm = 20;
  double least_cut_mm = 5;  ///< thinner tissue than this is never cut
  SheetMargin margin;
};

/// How much of the soft tissue just below the skin is labelled breast, from 0 to 1.
class BreastShare {
 public:
  BreastShare(const LabelVolume& labels, const Box& box);
  /// `skin` is a point of the skin with its outward normal.
  double below(const SheetPoint& skin) const;

 private:
  static constexpr double smoothing_mm = 3;
  OccupancyField breast_, soft_;
};

/// The ends of rays on the skin from the centre of the thick part.
struct RimRays {
  Vec2 centre;
  std::vector<Vec2> direction;  ///< unit, in the skin's parameters
  std::vector<double> border;   ///< radius at which the labelled breast ends
  std::vector<double> radius;   ///< radius at which the ray ends
  std::vector<RimEnd> end;
  double greatest_thickness_mm = 0;
};

/// Follows rays from the centre of the thick part outwards. Throws Error (input) if no part is thick
/// enough.
RimRays walk_rim(const HermiteSheet& skin, const WallSheet& wall, const BreastShare& share,
                 Side side, const Vec2& nipple_st, const RayOptions& options);

/// The radius, along a ray in the skin's parameters, at which the trusted part of the sheet ends.
double margin_radius(const Vec2& centre, const Vec2& direction, const SheetMargin& margin);

}  // namespace breast
