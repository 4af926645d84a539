// SPDX-License-Identifier: GPL-3.0-or-later
// The chest wall and the rib cage around it as one smooth surface without folds, given by a radius
// as a function of angle and height about an axis inside the thorax. Tissue that slides on the wall
// may leave the part that the breast covered in the scan, so that the surface extends far beyond
// it.
#pragma once

#include <vector>

#include "surface/level_surface.hpp"

namespace breast {

/// The level function is φ(x) = ρ − R(θ, z), where ρ and θ are the distance from the axis and the
/// angle about it (0 to the front, positive to the patient's left), and R is a uniform bicubic
/// B-spline. φ is twice continuously differentiable and positive outside the thorax. It is defined
/// between the ends of angle and height, except near the axis, where ρ < R/4.
struct ThoraxSurface final : LevelSurface {
  Vec3 origin{0, 0, 0};                    ///< a point of the axis, mm; heights count from its z
  double slope = 0;                        ///< of the axis: dy/dz, mm per mm
  double angle_low = 0, angle_high = 0;    ///< radians
  double height_low = 0, height_high = 0;  ///< mm above the origin
  int angles = 0, heights = 0;             ///< intervals of the spline
  /// B-spline coefficients of R, mm: (angles + 3) × (heights + 3), angle fastest.
  std::vector<double> coefficients;

  std::optional<Level> at(const Vec3& x) const override;
  /// The point of the surface at an angle (radians) and a height (mm) within the ends.
  Vec3 point(double angle, double height) const;
};

/// The surface `depth` mm behind `front`, along its normal to first order: that of the ribs behind a
/// layer of muscle.
ThoraxSurface surface_behind(const ThoraxSurface& front, double depth);

/// Coordinates relative to the axis: to the patient's left, to the front, and upwards.
struct AxisPlace {
  double left = 0, front = 0, height = 0;
};
AxisPlace about_axis(const ThoraxSurface& thorax, const Vec3& x);
/// Angle about the axis, radians: 0 to the front, positive to the patient's left.
double angle_of(const AxisPlace& place);

/// Weights of the four cubic B-splines that are not zero at `t` within an interval, 0 to 1, and
/// their first and second derivatives by t.
struct CubicSpline {
  double value[4], first[4], second[4];
};
CubicSpline cubic_spline(double t);

/// The interval of a spline with `count` intervals between `low` and `high`, and the position in
/// it, 0 to 1.
struct SplinePlace {
  int interval = 0;
  double t = 0;
};
SplinePlace spline_place(double at, double low, double high, int count);

}  // namespace breast
