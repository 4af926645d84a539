// SPDX-License-Identifier: GPL-3.0-or-later
// Untangling and smoothing of a placed template by the foldover-free energy.
#pragma once

#include "core/progress.hpp"
#include "meshing/place.hpp"

namespace breast {

/// The energy is E = Σ_corners ((1−θ)|A|²/(3 χ^{2/3}) + θ (det²A + 1)/(2 χ))^p + tether, where A
/// contains the corner's edges divided by h, χ = ½(det A + √(ε² + det²A)), and h is the edge of a
/// cube with the mean element volume (Garanzha et al., Foldover-free maps in 50 lines of code, ACM
/// TOG 40(4), 2021). On four real and phantom breasts, the worst scaled Jacobian was .57-.73 with p
/// = 8 and .43-.70 with p = 4.
struct SmoothOptions {
  double theta = 0.2;
  int power = 8;
  double tether =
      1e-3;  ///< weight of Σ|x − x_start|²/h²; raised for sliding nodes if volume is lost
  int evaluations = 300;        ///< at each of up to four weights of the tether
  int untangling_rounds = 8;    ///< of 60 evaluations each, while an element is folded
  double volume_change = 0.02;  ///< largest relative change of the volume
  bool mid_edges = false;       ///< sample the energy at mid-edges too (cuboid)
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
  /// Minimum scaled Jacobian before smoothing and of the mesh that is kept.
  double before = 0, after = 0;
  bool kept = false;  ///< whether the smoothed mesh is kept
  int evaluations = 0;
};

/// Smallest scaled Jacobian; a negative number if an element is folded, also between its corners.
double worst_shape(const std::vector<int>& connectivity, const std::vector<Vec3>& x);

/// Moves inner nodes in space; skin, wall and cut nodes in the parameters of their surfaces; and
/// rim nodes along their rim. Nodes in `held` (may be empty) are not moved. Of the meshes before
/// and after, the one with the larger minimum scaled Jacobian is kept.
SmoothReport smooth_nodes(const std::vector<int>& connectivity, const BodyMap& body,
                          const SmoothOptions& options, const std::vector<bool>& held,
                          PlacedNodes& nodes);

}  // namespace breast
