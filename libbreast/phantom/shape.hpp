// SPDX-License-Identifier: GPL-3.0-or-later
// The stress-free breast of the phantom: its base on the chest wall and its skin.
#pragma once

#include "phantom/chest/torso.hpp"

namespace breast {

/// Axes e1 (towards patient left), e2 (superior), e3 (out of the chest) are
/// right-handed on both sides.
class BreastShape {
 public:
  BreastShape(const PhantomParameters& parameters, const Torso& torso, Side side);

  Side side() const { return side_; }
  const Torso& torso() const { return torso_; }
  const Vec3& foot() const { return foot_; }  ///< intersection of the axis with the chest wall
  const Vec3& axis() const { return axes_[2]; }
  const Vec3& apex() const {
    return apex_;
  }  ///< intersection of the axis with the skin, the base
     ///< of the nipple
  /// Unit radial direction at azimuth φ about the axis (0 = towards patient left, 90° superior).
  Vec3 radial(double azimuth) const;
  /// The coordinates (r, φ, h) of a stress-free point: distance from the axis, azimuth, and height
  /// above the plane of the axis' foot.
  Vec3 cylindrical(const Vec3& x) const;
  Vec3 at(double r, double azimuth, double h) const {
    return foot_ + r * radial(azimuth) + h * axis();
  }

  /// Approximate signed distance (mm) to the skin of breast and chest, without nipple; < 0 inside.
  double skin_distance(const Vec3& x) const;
  /// The same distance including the nipple, as shown in the image.
  double outline(const Vec3& x) const;
  /// Distance to the nipple's body, negative inside.
  double nipple_distance(const Vec3& x) const;
  /// Distance to the breast's body minus distance to the chest's skin minus `part` times the
  /// fillet's width (mm). On the skin it vanishes at the middle of the fold for part 0, and for
  /// part 1 at the end of the fillet, beyond which the breast does not influence the chest's skin.
  double beyond_fold(const Vec3& x, double part) const;
  /// Skin thickness (mm), larger at the areola.
  double skin_thickness(const Vec3& x) const;
  Vec3 skin_normal(const Vec3& x) const;
  double radius(double azimuth) const;
  const BreastParameters& parameters() const { return p_; }

 private:
  double body_distance(const Vec3& local) const;
  double fold(double azimuth) const;

  BreastParameters p_;
  Torso torso_;
  Side side_;
  double skin_;
  std::uint64_t seed_;
  Vec3 foot_, apex_;
  std::array<Vec3, 3> axes_;
};

}  // namespace breast
