// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensitivity/plate_motion.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "mesh/compressed_pose.hpp"

namespace breast {

namespace {

Plate recorded_plate(const PlateRecord& record, const ViewPose& pose, double sign) {
  Plate plate = plate_facing(pose);
  plate.name = record.name;
  plate.sign = sign;
  // normal = (sign n − tilt e_u) / |…|
  const double along = record.normal.dot(pose.n) * sign;
  if (!(along > 0.5)) {
    throw input_error("contact record: plate ", record.name, " does not face the beam of ",
                      pose.angle_deg, " degrees");
  }
  plate.tilt_slope = -record.normal.dot(pose.e_u) / along;
  plate.edge_radius = record.edge_radius;
  plate.edge_start = plate.mid_depth = record.origin.dot(pose.e_u);
  plate.level = record.origin.dot(pose.n);
  plate.lateral_centre = record.origin.dot(pose.e_v);
  plate.far_edge = plate.half_width = std::numeric_limits<double>::infinity();
  return plate;
}

}  // namespace

PlatePair recorded_plates(const HexMesh& mesh) {
  if (!mesh.contact || mesh.contact->plates.size() != 2) {
    throw input_error("the state has no record of two plates; make it with compress");
  }
  const ViewPose pose = compressed_pose(mesh);
  PlatePair plates;
  plates.paddle = recorded_plate(mesh.contact->plates[0], pose, 1);
  plates.detector = recorded_plate(mesh.contact->plates[1], pose, -1);
  plates.angle_axis = pose.angle_axis;
  plates.initial_thickness = mesh.contact->initial_thickness_mm;
  plates.standoff = mesh.contact->standoff_mm;
  // The share is the only information in the file about how far the detector may rise.
  plates.detector_rise =
      mesh.contact->paddle_share < 1 ? std::numeric_limits<double>::infinity() : 0;
  return plates;
}

std::vector<PlateContact> recorded_contacts(const HexMesh& mesh, const PlatePair& plates) {
  std::vector<PlateContact> contacts;
  for (const int node : nodes_of(mesh, mesh.skin_faces)) {
    if (!(mesh.contact_pressure[std::size_t(node)] > 0)) continue;
    const Vec3& x = mesh.points[std::size_t(node)];
    PlateContact contact{node, plates.nearer(x), {}, 0};
    contact.gap = plates.plate(contact.plate).gap(x);
    contacts.push_back(contact);
  }
  return contacts;
}

namespace {
// About a horizontal line through the middle of the plates' edges: dn/dθ of n = (s sin θ, 0, −cos θ)
// is ω × n with ω = s times the axis of the angle.
Vec3 plate_turn(const PlatePair& plates, const Parameter& parameter, Side side) {
  if (parameter.kind != ParameterKind::angle) return Vec3::Zero();
  return lateral_sign(side) * std::numbers::pi / 180 * plates.angle_axis;
}
}  // namespace

Vec3 plate_velocity(const PlatePair& plates, int k, const Vec3& x, const Parameter& parameter,
                    Side side) {
  const Plate& plate = plates.plate(k);
  switch (parameter.kind) {
    case ParameterKind::thickness: {
      const double paddle = plates.paddle_share();
      return -(k == 0 ? paddle : 1 - paddle) * plate.sign * plate.n;
    }
    case ParameterKind::standoff:
      return plate.anterior;
    case ParameterKind::detector:
      return -plate.n;
    case ParameterKind::angle: {
      const Vec3 centre = 0.5 * (plates.paddle.origin() + plates.detector.origin());
      return plate_turn(plates, parameter, side).cross(x - centre);
    }
    default:
      return Vec3::Zero();
  }
}

// For a plate that moves with velocity v at a point and rotates with ω, the gap at a fixed point
// changes by −∇g·v and its gradient by ω × ∇g − ∇²g v.
GapSlope gap_slope(const PlatePair& plates, const PlateContact& contact, const Vec3& x,
                   const Parameter& parameter, Side side) {
  const Vec3 velocity = plate_velocity(plates, contact.plate, x, parameter, side);
  const Vec3 turn = plate_turn(plates, parameter, side);
  return {-contact.gap.gradient.dot(velocity),
          turn.cross(contact.gap.gradient) - contact.gap.hessian * velocity};
}

}  // namespace breast
