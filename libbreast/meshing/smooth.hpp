// SPDX-License-Identifier: GPL-3.0-or-later
// Untangling and smoothing of a placed template by the foldover-free energy.
#pragma once

#include "core/progress.hpp"
#include "meshing/place.hpp"

namespace breast {

/// E = Σ_corners ((1−θ)|A|²/(3 χ^{2/3}) + θ (det²A + 1)/(2 χ))^p + tether, A = corner edges / h, χ
/// = ½(det A + √(ε² + det²A)): Garanzha et al., Foldover-free maps in 50 lines of code, ACM TOG
/// 40(4), 2021. h is the edge of a cube of the mean element volume. p = 8 measured on four real and
/// phantom breasts: worst scaled Jacobian .57-.73, with p = 4 .43-.70.
struct SmoothOptions {
  double theta = 0.2;
  int power = 8;
  double tether = 1e-3;  ///< weight of Σ|x − x_start|²/h²
  int evaluations = 300;
  double volume_change = 0.02;
  bool mid_edges = false;  ///< sample the energy at mid-edges too (cuboid)
};

/// The cuboid's flat corners cannot become well shaped: a high power would sacrifice all others for
/// them.
inline SmoothOptions for_cuboid(SmoothOptions options) {
  options.theta = 0.3;
  options.power = 4;
  options.mid_edges = true;
  return options;
}

struct SmoothReport {
  double before = 0, after = 0;  ///< minimum scaled Jacobian; after is of the mesh kept
  bool kept = false;             ///< the smoothed mesh was better
  int evaluations = 0;
};

/// Smallest scaled Jacobian; when an element is folded (between its
/// corners too), a negative number.
double worst_shape(const std::vector<int>& connectivity, const std::vector<Vec3>& x);

/// Moves inside nodes in space, skin, wall and cut nodes in their parameters, rim nodes along
/// their rim. Nodes in `held` (may be empty) are not moved. Of the meshes before and after, keeps
/// the one with the larger minimum scaled Jacobian.
SmoothReport smooth_nodes(const std::vector<int>& connectivity, const BodyMap& body,
                          const SmoothOptions& options, const std::vector<bool>& held,
                          PlacedNodes& nodes);

}  // namespace breast
