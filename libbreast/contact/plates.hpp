// SPDX-License-Identifier: GPL-3.0-or-later
// The compression plates as rigid bodies: a flat, rounded edges, upright walls behind them. The
// signed distance and its first two derivatives are all the contact solver sees of them.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "mesh/hex_mesh.hpp"
#include "views/view_pose.hpp"

namespace breast {

/// Distance of a point to a plate, with derivatives by the point's position.
struct Gap {
  double value = 0;             ///< mm, negative inside the plate
  Vec3 gradient{0, 0, 0};       ///< unit normal of the plate where it is nearest
  Mat3 hessian = Mat3::Zero();  ///< 1/mm
};

/// How a gap and its gradient change at a fixed point while a plate moves, per unit of what moves it.
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

  /// Signed distance. Inside the plate it is to the flat, from where the plate came.
  Gap gap(const Vec3& x) const;
  /// How far the plate must draw back along the beam for the point to lie
  /// outside, mm; 0 if it does.
  double overlap(const Vec3& x) const;
  /// Where the plate has moved along the beam: points fixed to it differ by this, mm.
  Vec3 shift() const { return level * n; }
  /// Unit normal of the flat, from the plate into the gap.
  Vec3 normal() const;
  /// Point of the flat where the rounded edge starts, mid-width.
  Vec3 origin() const;

 private:
  struct Place;
  Place place(const Vec3& x) const;
};

/// A paddle of no extent yet, square to the beam of `pose`.
Plate plate_facing(const ViewPose& pose);

/// How the plates are placed; lengths in mm.
struct PlateOptions {
  /// Most anterior pectoral or cut point to the start of the rounded edge; without it a third of
  /// the breast's depth in front of that point, at most 25.
  std::optional<double> standoff;
  /// Where the rounded edge starts along the anterior axis (−y of the patient), instead of
  /// standoff: one machine about several meshes of a breast.
  std::optional<double> edge_at;
  /// Where the plane lies, along the beam, about which they close; for the same purpose.
  std::optional<double> middle_at;
  /// From the most anterior pectoral point to the edge of the image, where the rounded edge starts;
  /// instead of standoff, which counts points of the cut as well.
  std::optional<double> image_edge;
  /// By which the edge is turned towards the breast's side about the patient's long axis; without it
  /// until it lies along the wall behind the breast.
  std::optional<double> turn_deg = 0;
  double edge_radius = 15;
  double tilt_deg = 0;  ///< paddle about the lateral axis; positive narrows the gap anteriorly
  double width = 0;     ///< lateral size of the flats, 0: half as wide again as the body
  /// mm by which the detector lifts the breast from where it hangs before the paddle does the rest;
  /// infinite: to the mid-plane of the stress-free breast, both plates moving alike.
  double detector_rise = std::numeric_limits<double>::infinity();
};

/// Paddle and detector moving on one parameter, the thickness T between the flats at mid-depth.
struct PlatePair {
  Plate paddle, detector;
  double initial_thickness = 0;   ///< T0: extent along n within the footprint of the body
  double touching_thickness = 0;  ///< T where the first skin node touches; ≥ T0 beside a wide base
  double underside = 0;           ///< h of the lower end of the body as it hangs over the detector
  double wall_point = 0;          ///< a of the most anterior pectoral or cut point
  double standoff = 0;
  double paddle_start = 0, detector_start = 0;                     ///< levels at T0
  double detector_rise = std::numeric_limits<double>::infinity();  ///< mm, as in PlateOptions

  /// Moves both plates to thickness T (mm).
  void close_to(double thickness);
  double thickness() const { return detector.level - paddle.level; }
  /// How much of any further closing the paddle does: a half, or all where the detector has risen as
  /// far as it may.
  double paddle_share() const;
  /// Of the plane about which the plates close, along the beam, mm.
  double middle() const { return 0.5 * (paddle_start + detector_start); }
  /// The smaller of the two gaps, and which plate it belongs to (0 paddle, 1 detector).
  int nearer(const Vec3& x) const;
  const Plate& plate(int k) const { return k == 0 ? paddle : detector; }
};

/// `plate` as the paddle and its mirror image as the detector; their levels are left to the caller.
PlatePair paddle_and_detector(const Plate& plate);

/// The turn that lays the plates' edge along the chest wall behind the breast, degrees: that of the
/// mean normal of the wall in the shape `x`, at most 45 to either side.
double wall_turn_deg(const HexMesh& mesh, const std::vector<Vec3>& x);

/// Places the plates about the shape `x` (node positions of the gravity-loaded body, mm, LPS). They
/// close on the mid-plane of mesh.reference within the same footprint: upright the breast hangs
/// below it, and plates that met where it hangs would drag it down the held chest wall (on the two
/// anatomies tried, with up to ten times the force). The detector lifts it, as in the clinic.
/// Throws Error (input) when the plates miss the breast.
PlatePair place_plates(const HexMesh& mesh, const std::vector<Vec3>& x, const ViewPose& pose,
                       const PlateOptions& options);
/// `placed` with the same edge, but beginning about another shape of the body.
PlatePair start_from(const PlatePair& placed, const HexMesh& mesh, const std::vector<Vec3>& x,
                     const ViewPose& pose, PlateOptions options);

}  // namespace breast
