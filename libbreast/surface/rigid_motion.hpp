// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid motion, such as that of a rib cage between two scans. Its angles are the same on every processor, because segment uses it.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/elementary.hpp"
#include "core/types.hpp"

namespace breast {

/// The map x ↦ centre + R (x − centre) + shift, where R is the rotation about the vector `turn` by
/// its length.
struct RigidMotion {
  Vec3 centre{0, 0, 0}, shift{0, 0, 0};  ///< mm
  Vec3 turn{0, 0, 0};                    ///< degrees

  static constexpr double radians = std::numbers::pi / 180;

  Mat3 rotation() const {
    const double angle = turn.norm() * radians;
    if (!(angle > 0)) return Mat3::Identity();
    const Vec3 axis = turn.normalized();
    const double c = elementary::cos(angle), s = elementary::sin(angle);
    return c * Mat3::Identity() + s * cross(axis) + (1 - c) * axis * axis.transpose();
  }
  Vec3 operator()(const Vec3& x) const { return centre + rotation() * (x - centre) + shift; }
  /// The point that is mapped to y.
  Vec3 origin_of(const Vec3& y) const {
    return centre + rotation().transpose() * (y - centre - shift);
  }
  /// The composition of `other` followed by this motion, about the centre of `other`.
  RigidMotion after(const RigidMotion& other) const {
    RigidMotion both;
    both.centre = other.centre;
    both.shift = (*this)(other(other.centre)) - other.centre;
    const Eigen::Quaterniond turned(Mat3(rotation() * other.rotation()));
    const double sine = turned.vec().norm();  // of half the angle
    const double angle = 2 * elementary::atan2(sine, std::abs(turned.w()));
    if (sine > 0) both.turn = std::copysign(angle / radians / sine, turned.w()) * turned.vec();
    return both;
  }
  /// Derivative of the image of x with respect to `turn`, mm per degree (the left Jacobian of the
  /// rotation group).
  Mat3 by_turn(const Vec3& x) const {
    const double angle = turn.norm() * radians;
    Mat3 left = Mat3::Identity();
    if (angle > 1e-12) {
      const Vec3 axis = turn.normalized();
      const double s = elementary::sin(angle) / angle;
      left = s * left + (1 - s) * axis * axis.transpose() +
             (1 - elementary::cos(angle)) / angle * cross(axis);
    }
    return -radians * cross(rotation() * (x - centre)) * left;
  }

 private:
  static Mat3 cross(const Vec3& a) {
    Mat3 m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
  }
};

}  // namespace breast
