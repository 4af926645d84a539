// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/plates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "mesh/muscle_front.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"
#include "mesh/plate_edge.hpp"

namespace breast {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Smallest edge radius, mm: at a corner the direction of a force would be undefined.
constexpr double least_edge_radius = 1.0;
/// Default stand-off: this fraction of the breast's depth, and at most this many mm.
constexpr double standoff_part = 1.0 / 3, most_standoff = 25;
/// A plate must reach at least this far over the breast to compress it, mm.
constexpr double least_depth = 5.0;

struct Extent {
  double low = infinity, high = -infinity;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(low <= high); }
  double size() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
};

/// Extent along n of the skin in front of the plane a = start; faces are cut exactly at that plane.
Extent footprint_extent(const HexTopology& mesh, const std::vector<Vec3>& x, const Plate& plate) {
  Extent extent;
  const auto inside = [&](const Vec3& point) {
    return std::abs(point.dot(plate.lateral) - plate.lateral_centre) <= plate.half_width;
  };
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (int c = 0; c < 4; ++c) {
      const Vec3& here = x[nodes[c]];
      const Vec3& next = x[nodes[(c + 1) % 4]];
      const double a = plate.in_front(here);
      const double b = plate.in_front(next);
      if (a >= 0 && inside(here)) extent.add(here.dot(plate.n));
      if ((a < 0) != (b < 0)) {
        const Vec3 crossing = here + a / (a - b) * (next - here);
        if (inside(crossing)) extent.add(crossing.dot(plate.n));
      }
    }
    for (std::size_t c = 4; c < nodes.size(); ++c) {
      const Vec3& here = x[nodes[c]];
      if (plate.in_front(here) >= 0 && inside(here)) {
        extent.add(here.dot(plate.n));
      }
    }
  }
  return extent;
}

/// Most anterior point of the chest wall (of the front of the muscle, if the mesh has muscle) or of
/// the cut, within the width of the plate.
double most_anterior_wall(const HexTopology& mesh, const std::vector<Vec3>& x, const Plate& plate,
                          bool with_cut) {
  double wall = -infinity;
  for (const auto& faces : {muscle_front(mesh), with_cut ? mesh.cut_faces : std::vector<Face>{}}) {
    for (const int node : nodes_of(mesh, faces)) {
      const double v = x[node].dot(plate.lateral);
      if (std::abs(v - plate.lateral_centre) <= plate.half_width) {
        wall = std::max(wall, x[node].dot(plate.anterior));
      }
    }
  }
  return wall;
}

void check_options(const PlateOptions& options) {
  if (options.standoff && !(*options.standoff >= 0)) {
    throw input_error("plate stand-off ", *options.standoff, " mm: must be 0 or more");
  }
  if (!(options.edge_radius >= 0)) {
    throw input_error("plate edge radius ", options.edge_radius, " mm: must be 0 or more");
  }
  if (!(std::abs(options.tilt_deg) <= 20)) {
    throw input_error("paddle tilt ", options.tilt_deg, " degrees: must lie within -20 and 20");
  }
  if (!(options.width >= 0)) {
    throw input_error("plate width ", options.width, " mm: must be 0 (automatic) or more");
  }
  if (!(options.detector_rise >= 0)) {
    throw input_error("detector raised by ", options.detector_rise, " mm: must be 0 or more");
  }
}

/// Plate coordinates that do not depend on its level: width, edge start, far edge, mid-depth.
/// `breast`: the depth (coordinate a) at which the breast begins whose thickness is T0. It is that of the plates' edge, but
/// between plates at the edge of the image that of plates with the default stand-off, which leave out the skin of the trunk.
Plate place_in_plane(const HexTopology& mesh, const std::vector<Vec3>& x, const ViewPose& pose,
                     const PlateOptions& options, double& wall_point, double& breast) {
  Plate plate = plate_facing(pose);
  plate.edge_radius = std::max(least_edge_radius, options.edge_radius);
  const std::vector<int> skin = nodes_of(mesh, mesh.skin_faces);
  Extent across, along;
  for (const int node : skin) {
    across.add(x[node].dot(plate.lateral));
    along.add(x[node].dot(plate.anterior));
  }
  if (across.empty()) throw input_error("the mesh has no skin faces for the plates to press on");
  plate.lateral_centre = across.middle();
  plate.half_width = options.width > 0 ? 0.5 * options.width : 0.75 * across.size();
  wall_point = most_anterior_wall(mesh, x, plate, !options.image_edge);
  if (!std::isfinite(wall_point)) {
    throw input_error("no pectoral or cut point lies within the plates' width of ",
                      2 * plate.half_width, " mm");
  }
  const double automatic = std::min(most_standoff, standoff_part * (along.high - wall_point));
  plate.edge_start = options.edge_at.value_or(
      wall_point + options.image_edge.value_or(options.standoff.value_or(automatic)));
  breast = plate.edge_start;
  if (options.image_edge) breast = std::max(breast, wall_point + automatic);
  const double depth = along.high - plate.edge_start;
  if (!(depth >= least_depth)) {
    throw input_error(
        "the plates miss the breast: with a stand-off of ", plate.edge_start - wall_point,
        " mm they start ", depth >= 0 ? "only " : "", std::abs(depth), " mm ",
        depth >= 0 ? "behind" : "in front of", " the most anterior skin (at least ", least_depth,
        " mm of overlap are needed); try --standoff ",
        std::max(0.0, std::floor(plate.edge_start - wall_point + depth - 4 * least_depth)));
  }
  plate.mid_depth = plate.edge_start + 0.5 * depth;
  // Compression lengthens the breast forwards; the front edge of the plate must remain in front of
  // it.
  plate.far_edge = plate.edge_start + 2 * depth + 20;
  return plate;
}

/// Sum of the areas of the chest wall's faces as vectors out of the body, mm².
Vec3 towards_ribs(const HexTopology& mesh, const std::vector<Vec3>& x) {
  Vec3 outward = Vec3::Zero();
  for (const Vec3& part : nodal_faces(mesh, mesh.pectoral_faces, flatten(x)).vector)
    outward += part;
  return outward;
}

/// Skin behind the footprint may extend beyond T0: this is the thickness at which nothing is
/// penetrated.
double touching_thickness(const HexTopology& mesh, const std::vector<Vec3>& x, PlatePair pair) {
  const std::vector<int> skin = nodes_of(mesh, mesh.skin_faces);
  double thickness = pair.initial_thickness, opening = 1;
  // One pass suffices, except for a tilted paddle, whose edge moves across the body as it retreats.
  for (int k = 0; k < 20 && opening > 1e-9; ++k) {
    opening = 0;
    for (const int node : skin) {
      for (int side = 0; side < 2; ++side) {
        opening = std::max(opening, 2 * pair.plate(side).overlap(x[node]));
      }
    }
    thickness += opening;
    pair.close_to(thickness);
  }
  return thickness;
}
}  // namespace

/// A point in plate coordinates: its height over the flat, and the vector to it from the outline of
/// the prism.
struct Plate::Place {
  Vec3 normal;
  double height = 0;     ///< height over the flat, mm
  Vec3 beyond{0, 0, 0};  ///< from the outline of the flat to the point, in its plane, mm
  /// Projection onto the directions in which the point lies beyond the outline.
  Mat3 across = Mat3::Zero();
};

Plate::Place Plate::place(const Vec3& x) const {
  Place at;
  at.normal = normal();
  const Vec3 from = x - origin();
  at.height = from.dot(at.normal);
  const auto pass = [&](double s, const Vec3& outward) {
    if (!(s > 0)) return;
    at.beyond += s * outward;
    at.across += outward * outward.transpose();
  };
  const Vec3 along = (anterior + tilt_slope * sign * n).normalized();
  const double a = from.dot(along), v = from.dot(lateral);
  pass(-a, -along);
  pass(a - (far_edge - edge_start), along);
  pass(v - half_width, lateral);
  pass(-v - half_width, -lateral);
  return at;
}

Gap Plate::gap(const Vec3& x) const {
  const Place at = place(x);
  const double above = at.height + edge_radius;  // the top of the swept prism lies one radius lower
  if (at.beyond.isZero()) return {at.height, at.normal, Mat3::Zero()};
  const Vec3 to = at.beyond + std::max(0.0, above) * at.normal;
  const double length = to.norm();
  const Vec3 direction = to / length;
  Mat3 moving = at.across;
  if (above > 0) moving += at.normal * at.normal.transpose();
  return {length - edge_radius, direction, (moving - direction * direction.transpose()) / length};
}

double Plate::overlap(const Vec3& x) const {
  const Place at = place(x);
  const double down = edge_recession(edge_radius, at.beyond.norm());
  return std::isinf(down) ? 0 : std::max(0.0, -(at.height + down)) / at.normal.dot(sign * n);
}

Vec3 Plate::normal() const {
  return (sign * n - tilt_slope * anterior).normalized();
}

Vec3 Plate::origin() const {
  const double h = level + sign * tilt_slope * (edge_start - mid_depth);
  return h * n + edge_start * anterior + lateral_centre * lateral;
}

void PlatePair::close_to(double thickness) {
  const double closing = initial_thickness - thickness;
  // Each plate moves by one half until the detector has reached its highest position; then only the
  // paddle moves.
  const double risen = std::min(0.5 * closing, detector_rise);
  paddle.level = paddle_start + moved + closing - risen;
  detector.level = detector_start + moved - risen;
}

double PlatePair::paddle_share() const {
  return 0.5 * (initial_thickness - thickness()) < detector_rise ? 0.5 : 1;
}

int PlatePair::nearer(const Vec3& x) const {
  return paddle.gap(x).value <= detector.gap(x).value ? 0 : 1;
}

Plate plate_facing(const ViewPose& pose) {
  Plate plate;
  plate.n = pose.n;
  plate.anterior = pose.e_u;
  plate.lateral = pose.e_v;
  return plate;
}

PlatePair paddle_and_detector(const Plate& plate) {
  PlatePair pair;
  pair.paddle = pair.detector = plate;
  pair.paddle.name = "paddle";
  pair.detector.name = "detector";
  pair.detector.sign = -1;
  return pair;
}

PlatePair place_plates(const HexMesh& mesh, const std::vector<Vec3>& x, const ViewPose& pose,
                       const PlateOptions& options) {
  check_options(options);
  double wall_point = 0, breast_from = 0;
  const Plate plate = place_in_plane(mesh, x, pose, options, wall_point, breast_from);
  PlatePair pair = paddle_and_detector(plate);
  pair.wall_point = wall_point;
  pair.angle_axis = pose.angle_axis;
  pair.standoff = plate.edge_start - wall_point;
  pair.detector_rise = options.detector_rise;
  pair.paddle.tilt_slope = std::tan(options.tilt_deg * std::numbers::pi / 180);

  const Extent extent = footprint_extent(mesh, x, plate);
  if (extent.empty() || !(extent.size() > 0)) {
    throw input_error("the plates' footprint contains no skin; try a smaller --standoff");
  }
  Plate over_breast = plate;
  over_breast.edge_start = breast_from;
  const Extent breast = footprint_extent(mesh, x, over_breast);
  pair.closing_range = extent.size();
  pair.initial_thickness = breast.size();
  pair.underside = breast.high;
  // A detector that does not lift the breast completely stands under the hanging breast.
  const Extent unloaded = footprint_extent(mesh, mesh.reference, plate);
  const bool lifts = std::isinf(options.detector_rise) && !unloaded.empty();
  const double middle = options.middle_at.value_or((lifts ? unloaded : extent).middle());
  pair.paddle_start = middle - 0.5 * pair.initial_thickness;
  pair.detector_start = middle + 0.5 * pair.initial_thickness;
  pair.close_to(pair.initial_thickness);

  pair.touching_thickness = touching_thickness(mesh, x, pair);
  pair.close_to(pair.touching_thickness);
  return pair;
}

double wall_turn_deg(const HexTopology& mesh, const std::vector<Vec3>& x, double most) {
  const Vec3 outward = towards_ribs(mesh, x);
  if (!(outward.head<2>().norm() > 0)) return 0;
  const double turn = std::atan2(-lateral_sign(mesh.side) * outward.x(), outward.y());
  return std::clamp(turn * 180 / std::numbers::pi, -most, most);
}

double muscle_lean_deg(const HexTopology& mesh, const std::vector<Vec3>& x, const ViewPose& pose) {
  constexpr double beyond_parallel = 4, most = 25, least_angle = 20;
  if (std::abs(pose.angle_deg) < least_angle) return 0;
  const Vec3 forwards = -towards_ribs(mesh, x);
  const ViewPose upright = view_pose(mesh.side, pose.angle_deg, pose.turn_deg);
  Vec3 upwards = upright.e_v;
  if (upwards.z() < 0) upwards = -upwards;
  if (!(forwards.norm() > 0)) return 0;
  const double parallel = std::atan2(forwards.dot(upwards), forwards.dot(upright.e_u));
  return std::clamp(parallel * 180 / std::numbers::pi + beyond_parallel, 0.0, most);
}

double wall_bend_deg(const HexTopology& mesh, const std::vector<Vec3>& x, const ViewPose& pose) {
  const Vec3 forwards = -towards_ribs(mesh, x);
  if (!(forwards.norm() > 0)) return 0;
  const double parallel = std::atan2(-forwards.dot(pose.n), forwards.dot(pose.e_u));
  return std::clamp(parallel * 180 / std::numbers::pi, 0.0, most_auto_bend_deg);
}

double balanced_bend_deg(double bend_deg, const std::array<double, 2>& on_edge) {
  // The more she bends, the nearer her chest is to the paddle's edge, and the farther from the detector's. On CC views of
  // women with small breasts one degree changed the difference of the shares by 0.10 to 0.12, measured over 2 to 5 degrees.
  constexpr double difference_per_degree = 0.12, most_change = 4;
  const double change = (on_edge[1] - on_edge[0]) / difference_per_degree;
  return std::clamp(bend_deg + std::clamp(change, -most_change, most_change), 0.0,
                    most_auto_bend_deg);
}

ViewPose place_pose(const HexTopology& mesh, const std::vector<Vec3>& x, double angle_deg,
                    const PlateOptions& options) {
  const double turn =
      options.turn_deg ? *options.turn_deg : wall_turn_deg(mesh, x, options.most_turn_deg);
  const ViewPose turned = view_pose(mesh.side, angle_deg, turn);
  const double lean = options.lean_deg ? *options.lean_deg : muscle_lean_deg(mesh, x, turned);
  const ViewPose upright = view_pose(mesh.side, angle_deg, turn, lean);
  const double bend = options.bend_deg ? *options.bend_deg : wall_bend_deg(mesh, x, upright);
  return view_pose(mesh.side, angle_deg, turn, lean, bend);
}

}  // namespace breast
