// SPDX-License-Identifier: GPL-3.0-or-later
// The compression plates as rigid bodies with a flat part, rounded edges and upright walls. The
// contact solver uses only the signed distance and its first two derivatives.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/view_pose.hpp"

namespace breast {

/// Signed distance of a point from a plate, with derivatives with respect to the point's position.
struct Gap {
  double value = 0;             ///< mm, negative inside the plate
  Vec3 gradient{0, 0, 0};       ///< unit normal of the plate at its closest point
  Mat3 hessian = Mat3::Zero();  ///< 1/mm
};

/// Rates of change of a gap and its gradient at a fixed point while the plate moves, per unit of
/// its motion parameter.
struct GapSlope {
  double value = 0;
  Vec3 gradient{0, 0, 0};
};

/// One plate: a ball of radius edge_radius swept over a prism with an upright wall
/// behind, before and beside it. Coordinates: h along the beam, a anterior, v lateral (h,
/// a, v = x·n, x·e_u, x·e_v).
struct Plate {
  std::string name;  ///< "paddle" or "detector"
  double sign = 1;   ///< +1 when the body lies towards +h (paddle), −1 (detector)
  Vec3 n{0, 0, -1}, anterior{0, -1, 0}, lateral{1, 0, 0};
  double level = 0;       ///< h of the flat at depth mid_depth
  double edge_start = 0;  ///< a where the rounded edge towards the chest wall starts
  double far_edge = 0;    ///< a where the anterior rounded edge starts
  double lateral_centre = 0, half_width = 0;  ///< flat: |v − centre| ≤ half_width
  double mid_depth = 0;    ///< a of the tilt axis, where the thickness is defined
  double tilt_slope = 0;   ///< rise into the gap per mm anterior
  double edge_radius = 0;  ///< mm

  /// Signed distance. Inside the plate it is measured to the flat, through which the point entered.
  Gap gap(const Vec3& x) const;
  /// Distance by which the plate must retreat along the beam so that the point lies outside, mm; 0
  /// if it already does.
  double overlap(const Vec3& x) const;
  /// How far a point lies in front of the start of the rounded edge, mm.
  double in_front(const Vec3& x) const { return x.dot(anterior) - edge_start; }
  /// Displacement of the plate along the beam, and hence of points fixed to it, mm.
  Vec3 shift() const { return level * n; }
  /// Unit normal of the flat, from the plate into the gap.
  Vec3 normal() const;
  /// Point of the flat where the rounded edge starts, mid-width.
  Vec3 origin() const;

 private:
  struct Place;
  Place place(const Vec3& x) const;
};

/// A paddle perpendicular to the beam of `pose`, whose extent is still to be set.
Plate plate_facing(const ViewPose& pose);

/// A point on which a plate presses: a node, or a quadrature point of a face.
struct PressedPoint {
  int plate = 0;        ///< 0 paddle, 1 detector
  Vec3 at{0, 0, 0};     ///< mm
  Vec3 force{0, 0, 0};  ///< on the body, µN
};

/// Options for the placement of the plates; lengths in mm.
struct PlateOptions {
  /// Distance from the most anterior chest-wall or cut point to the start of the rounded edge; by
  /// default a third of the breast's depth in front of that point, at most 25.
  std::optional<double> standoff;
  /// Coordinate of the start of the rounded edge along the anterior axis (−y of the patient),
  /// instead of standoff, so that several meshes of a breast can have the same plates.
  std::optional<double> edge_at;
  /// Coordinate, along the beam, of the plane about which the plates close; for the same purpose. It then stays there
  /// (CompressionOptions::follows_breast).
  std::optional<double> middle_at;
  /// Distance from the most anterior chest-wall point to the edge of the image, where the rounded
  /// edge starts; instead of standoff, which also considers points of the cut.
  std::optional<double> image_edge;
  /// If the rounded edges press on the chest wall instead of the breast (edge_carries_force), the plates are placed anew
  /// farther from it, up to this image_edge; absent: they are not.
  std::optional<double> farthest_image_edge;
  /// Angle by which the edge is turned towards the breast's side about the patient's long axis; if
  /// absent, the edge is made parallel to the chest wall behind the breast, but turned by at most `most_turn_deg`.
  std::optional<double> turn_deg = 0;
  double most_turn_deg = 45;
  /// Angle by which the edge is turned about the beam, with its upper end backwards; if absent,
  /// the edge is inclined so that an oblique image shows the muscle from above.
  std::optional<double> lean_deg = 0;
  /// Angle by which the patient bends forwards; if absent, the plates follow the wall (wall_bend_deg).
  std::optional<double> bend_deg = 0;
  double edge_radius = 15;
  double tilt_deg = 0;  ///< of the paddle about the lateral axis; positive narrows the gap
                        ///< anteriorly
  double width = 0;     ///< lateral size of the flat part; 0: 1.5 times the width of the body
  /// Distance by which the detector lifts the breast before only the paddle moves; infinite: up to
  /// the mid-plane of the stress-free breast, with both plates moving symmetrically.
  double detector_rise = std::numeric_limits<double>::infinity();
};

/// Paddle and detector, whose motion has one parameter: the thickness T between the flats at
/// mid-depth.
struct PlatePair {
  Plate paddle, detector;
  /// T0: extent of the breast along n within the footprint; between plates that are placed by the edge of the image,
  /// without the skin of the trunk that lies in front of it.
  double initial_thickness = 0;
  double closing_range = 0;       ///< extent along n of all skin in front of the edge, mm
  double touching_thickness = 0;  ///< T where the first skin node touches; ≥ T0 beside a wide base
  double underside = 0;           ///< h of the lower end of the body as it hangs over the detector
  double wall_point = 0;          ///< a of the most anterior pectoral or cut point
  double standoff = 0;
  Vec3 angle_axis{0, -1, 0};                    ///< ViewPose::angle_axis
  double paddle_start = 0, detector_start = 0;  ///< levels at T0
  double moved = 0;  ///< of the mid-plane along the beam since then, mm, towards the detector
  double detector_rise = std::numeric_limits<double>::infinity();  ///< mm, as in PlateOptions

  /// Moves both plates to thickness T (mm), about the mid-plane where it is now.
  void close_to(double thickness);
  double thickness() const { return detector.level - paddle.level; }
  /// Share of the paddle in any further closing: one half, or one if the detector has reached its
  /// highest position.
  double paddle_share() const;
  /// Coordinate, along the beam, of the plane about which the plates close, mm.
  double middle() const { return 0.5 * (paddle_start + detector_start) + moved; }
  /// The plate with the smaller gap (0 paddle, 1 detector).
  int nearer(const Vec3& x) const;
  const Plate& plate(int k) const { return k == 0 ? paddle : detector; }
};

/// `plate` as the paddle and its mirror image as the detector; the caller sets their levels.
PlatePair paddle_and_detector(const Plate& plate);

/// Angle (degrees) that makes the plates' edge parallel to the chest wall behind the breast: that
/// of the mean normal of the wall in the shape `x`, at most `most` in either direction.
double wall_turn_deg(const HexTopology& mesh, const std::vector<Vec3>& x, double most);
/// Angle (degrees, 0 to 25) about the beam of `pose` by which the edge of oblique plates leans: 4
/// degrees more than if it were parallel to the chest wall, so that its upper end lies in the axilla
/// behind the muscle and its lower end in front of the fold. 0 for a beam from head to foot.
double muscle_lean_deg(const HexTopology& mesh, const std::vector<Vec3>& x, const ViewPose& pose);

/// The farthest that a patient bends forwards without being told to, degrees.
constexpr double most_auto_bend_deg = 20;
/// Angle (degrees, 0 to most_auto_bend_deg) by which the patient bends forwards until the edges of both plates are equally far from her
/// chest wall in the shape `x`; `pose` is hers while she stands upright.
double wall_bend_deg(const HexTopology& mesh, const std::vector<Vec3>& x, const ViewPose& pose);
/// Angle (degrees, 0 to most_auto_bend_deg) by which the patient bends forwards so that both edges carry the same share of
/// their plate's force, if paddle and detector carry the shares `on_edge` at the angle `bend_deg`; at most 4 degrees from that.
double balanced_bend_deg(double bend_deg, const std::array<double, 2>& on_edge);
/// The pose with the angles that `options` state, the others chosen for the shape `x`.
ViewPose place_pose(const HexTopology& mesh, const std::vector<Vec3>& x, double angle_deg,
                    const PlateOptions& options);

/// Places the plates about the shape `x` (node positions of the gravity-loaded body, mm, LPS). They
/// close on the mid-plane of mesh.reference within the same footprint: in the upright posture the
/// breast hangs below this plane, and plates that met there would drag it down along the fixed
/// chest wall (with up to ten times the force on the two anatomies tried). The detector lifts the
/// breast, as in the clinic. Throws Error (input) when the plates miss the breast.
PlatePair place_plates(const HexMesh& mesh, const std::vector<Vec3>& x, const ViewPose& pose,
                       const PlateOptions& options);

}  // namespace breast
