// SPDX-License-Identifier: GPL-3.0-or-later
// Positioning of a breast between the plates by a hand that carries its weight and pulls it
// forwards, and releases it as the plates grip it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Initial position of the breast between the plates: hanging, or lifted by a hand that carries its
/// weight until the plates grip it.
enum class Positioning { hanging, lifted };

/// The reductions (fractions of the initial thickness) between which the hand releases the breast.
struct Release {
  double begins = 0, ends = 0;

  /// Share of the load that the hand has released at a reduction: 0 before `begins`, 1 from `ends`
  /// on.
  double at(double reduction) const;
};

/// When the hand releases the weight and the pull. The plates can carry the weight of a breast long
/// before friction can hold it against a pull.
struct Grip {
  Release weight, pull;
  /// Whether the hand has let go completely at a reduction (a fraction).
  bool gone(double reduction) const { return weight.at(reduction) == 1 && pull.at(reduction) == 1; }
};
/// For a compression to a given reduction (a fraction). If it may end before, at the first of this
/// and other targets, the pull ends earlier.
Grip grip_before(double reduction, bool may_end_before = false);
/// For a compression to a force or pressure, whose reduction is not known in advance: the hand
/// releases everything early.
Grip grip_before_any_force();

/// Nodal forces (µN, 3 per node) that pull the skin in front of the plates' edge away from the
/// chest wall with a total of `newton`: a uniform traction that rises from zero over the 20 mm next
/// to the edge. `x` are the positions in mm. Throws Error (input) if no skin lies in front of the
/// edge.
Eigen::VectorXd pull_forwards(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate,
                              double newton);

/// A stage of positioning and its effect on the tissue at the edge of the plates.
struct PositioningStage {
  std::string name;  ///< upright, lifted, pulled, compressed
  double volume_in_front_percent = 0;
  /// Mean displacement away from the chest wall, relative to the upright hanging breast, of the
  /// tissue that lay within 10 mm of the edge there, mm.
  double past_edge_mm = 0;
};
/// `upright` and `x`: positions (3 per node, mm) of the breast hanging upright and at this stage.
PositioningStage positioning_stage(std::string name, const HexMesh& mesh,
                                   const Eigen::VectorXd& upright, const Eigen::VectorXd& x,
                                   const Plate& plate);

}  // namespace breast
