// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/view_pose.hpp"

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

Vec3 turned_by_bend(const ViewPose& pose, const Vec3& direction) {
  return Eigen::AngleAxisd(pose.bend_deg * std::numbers::pi / 180, pose.e_v) * direction;
}

ViewPose view_pose(Side side, double angle_deg, double turn_deg, double lean_deg, double bend_deg) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double theta = angle_deg * degree, lean = lean_deg * degree;
  ViewPose pose;
  pose.angle_deg = angle_deg;
  pose.turn_deg = turn_deg;
  pose.lean_deg = lean_deg;
  pose.bend_deg = bend_deg;
  const double turn = lateral_sign(side) * turn_deg * degree;
  const Eigen::AngleAxisd turned(turn, Vec3::UnitZ());
  pose.n = turned * Vec3(lateral_sign(side) * std::sin(theta), 0, -std::cos(theta));
  pose.angle_axis = turned * Vec3(0, -1, 0);
  // Towards the head along the detector; across the body if the beam runs from head to foot.
  const Vec3 upwards = lateral_sign(side) * pose.angle_axis.cross(pose.n);
  pose.e_u = std::cos(lean) * pose.angle_axis + std::sin(lean) * upwards;
  pose.e_v = pose.n.cross(pose.e_u);
  pose.n = turned_by_bend(pose, pose.n);
  pose.e_u = turned_by_bend(pose, pose.e_u);
  return pose;
}

}  // namespace breast
