// SPDX-License-Identifier: GPL-3.0-or-later
// The pose of a mammographic view: beam direction and image axes in the patient's frame.
#pragma once

#include "core/types.hpp"

namespace breast {

/// Beam and image axes: n from paddle to detector, e_u = anterior (0,-1,0), e_v = n × e_u. The
/// parallel projection of a patient point x is (u,v) = ((x−origin)·e_u, (x−origin)·e_v). For a cone
/// beam, the point source lies source_distance above the detector's chest-wall edge at (0,
/// source_v).
struct ViewPose {
  Vec3 n{0, 0, -1}, e_u{0, -1, 0}, e_v{-1, 0, 0};
  /// Origin on the detector plane, mm LPS: the centre of pixel (0,0), where (u,v) = (0,0).
  Vec3 origin{0, 0, 0};
  double angle_deg = 0, turn_deg = 0, lean_deg = 0, bend_deg = 0;
  /// Axis about which a larger angle turns the pose, to the side of the breast.
  Vec3 angle_axis{0, -1, 0};
  double source_distance = 0;  ///< mm from detector to point source; 0 = parallel beam
  double source_v = 0;         ///< mm

  Vec3 source() const { return origin + source_v * e_v - source_distance * n; }
  Vec3 on_detector(const Vec2& uv) const { return origin + uv.x() * e_u + uv.y() * e_v; }
  Vec2 project(const Vec3& patient) const;
};
/// The pose with n = (s sin θ, 0, −cos θ), s = lateral_sign(side) and e_u = (0, −1, 0), both then
/// rotated about the patient's long axis by `turn_deg`, so that e_u becomes (s sin ψ, −cos ψ, 0).
/// Then e_u is rotated about the beam by `lean_deg` towards the patient's head, so that the upper
/// end of the detector's edge lies further back. Finally, n and e_u are rotated about e_v by `bend_deg`
/// (turned_by_bend): the patient bends forwards, so that her upper chest comes nearer to the paddle's edge.
ViewPose view_pose(Side side, double angle_deg, double turn_deg = 0, double lean_deg = 0,
                   double bend_deg = 0);
/// What a direction in the frame of the machine (such as that of gravity) becomes in the frame of a patient who bends
/// forwards by `pose.bend_deg`.
Vec3 turned_by_bend(const ViewPose& pose, const Vec3& direction);

}  // namespace breast
