// SPDX-License-Identifier: GPL-3.0-or-later
// Meridian curves of the stress-free breast: its skin and chest wall in
// half-planes through the axis.
#pragma once

#include <array>
#include <vector>

#include "phantom/shape.hpp"

namespace breast {

/// Skin and wall curves at 64 azimuths, interpolated smoothly between them. Each curve has two
/// parts with equal steps of arc length: the parameter is 0 at the axis, 1 at the fold (the middle
/// of the fillet between breast and chest) and 2 at the rim where the cut begins.
class MeridianMap {
 public:
  /// The rim lies `beyond` mm farther at the breast's side than the shape's parameters say. Throws
  /// Error (input) when the breast's outline cannot be followed to the chest.
  explicit MeridianMap(const BreastShape& shape, double beyond = 0);

  Vec3 skin(double parameter, double azimuth) const { return position(skin_, parameter, azimuth); }
  Vec3 wall(double parameter, double azimuth) const { return position(wall_, parameter, azimuth); }
  /// Mean height of the fold above the plane of the axis' foot (mm).
  double fold_height() const { return fold_height_; }
  /// Whether a point in front of the chest wall lies on the breast's side of the cut (extended
  /// straight outwards), more than `margin` mm from it.
  bool inside_cut(const Vec3& x, double margin) const;

 private:
  using Curve = std::vector<Vec2>;  ///< (r,h)
  Vec3 position(const std::vector<Curve>& curves, double parameter, double azimuth) const;

  const BreastShape& shape_;
  std::vector<Curve> skin_, wall_;  ///< per azimuth
  double fold_height_ = 0;
};

}  // namespace breast
