// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/view_pose.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace breast {

Vec2 ViewPose::project(const Vec3& patient) const {
  const Vec3 d = patient - origin;
  Vec2 uv(d.dot(e_u), d.dot(e_v));
  if (source_distance > 0) {
    const Vec2 foot(0, source_v);
    const double height = -d.dot(n);  // above the detector
    uv = foot + (uv - foot) * (source_distance / (source_distance - height));
  }
  return uv;
}

ViewPose view_pose(Side side, double angle_deg, double turn_deg) {
  const double theta = angle_deg * std::numbers::pi / 180.0;
  ViewPose pose;
  pose.angle_deg = angle_deg;
  pose.turn_deg = turn_deg;
  const double turn = lateral_sign(side) * turn_deg * std::numbers::pi / 180.0;
  const Eigen::AngleAxisd turned(turn, Vec3::UnitZ());
  pose.n = turned * Vec3(lateral_sign(side) * std::sin(theta), 0, -std::cos(theta));
  pose.e_u = turned * Vec3(0, -1, 0);
  pose.e_v = pose.n.cross(pose.e_u);
  return pose;
}

}  // namespace breast
