// SPDX-License-Identifier: GPL-3.0-or-later
// What a compression leaves in a mesh: the pose of its plates, their forces, and what friction holds.
#pragma once

#include <string>
#include <vector>

#include "core/types.hpp"
#include "mesh/view.hpp"

namespace breast {

/// Result of compress for one plate (file group /breast/contact).
struct PlateRecord {
  std::string name;         ///< "paddle" or "detector"
  Vec3 normal{0, 0, 1};     ///< unit, from the plate into the gap
  Vec3 anterior{0, -1, 0};  ///< unit, in the plate, away from the chest wall
  Vec3 origin{0, 0, 0};     ///< point of the flat where the rounded edge starts, mid-width
  double edge_radius = 0;   ///< mm
  double force_N = 0, area_cm2 = 0, mean_kPa = 0, peak_kPa = 0;
  /// Greatest penetration of the plate by the body, mm, over sampled points of every free boundary
  /// face.
  double worst_gap_mm = 0;
};
/// A node that is held by the friction of a plate in the compressed state.
struct FrictionRecord {
  int node = 0, plate = 0;
  Vec3 anchor{0, 0, 0};  ///< mm
  double bound = 0;      ///< largest friction force, µN
  double stick = 0;      ///< stiffness of the anchor spring, µN/mm
};
struct ContactRecord {
  View view = View::cc;
  double angle_deg = 0;  ///< beam angle θ, degrees from craniocaudal
  /// Angle by which the plates' edge is turned towards the breast's side about the patient's long
  /// axis.
  double turn_deg = 0;
  /// Angle by which it is turned about the beam, with its upper end backwards.
  double lean_deg = 0;
  /// Angle by which the patient bends forwards: beam and edge are turned about the direction along the edge.
  double bend_deg = 0;
  /// Whether the image ends at the plates' edge, as in the clinic, or at the chest wall.
  bool ends_image = false;
  /// Stiffness of the plates against faces, Pa/mm; 0: exact contact at nodes.
  double surface_stiffness = 0;
  /// The number of the set of quadrature points of every face that may touch; empty in files that
  /// lack it.
  std::vector<int> face_rules;
  double thickness_mm = 0, reduction_percent = 0, initial_thickness_mm = 0, standoff_mm = 0;
  std::vector<PlateRecord> plates;
  std::vector<FrictionRecord> friction;  ///< in surface contact with friction
  /// Share of the paddle in any further closing: one half, or one if the detector has reached its
  /// highest position.
  double paddle_share = 0.5;
  /// The path of the compression: thickness, and the force of paddle and detector (the latter may
  /// be empty).
  std::vector<double> path_thickness_mm, path_force_N, path_detector_N;
};

}  // namespace breast
