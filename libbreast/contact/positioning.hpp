// SPDX-License-Identifier: GPL-3.0-or-later
// A breast is brought between the plates by a hand: it carries the weight and pulls the breast
// forwards, and lets go while the plates grip.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// How the breast comes between the plates: as it hangs, or lifted by a hand that carries its weight
/// until the plates grip it.
enum class Positioning { hanging, lifted };

/// The reductions (fractions of the initial thickness) between which the hand lets go.
struct Release {
  double begins = 0, ends = 0;

  /// The part that the hand has let go of at a reduction: 0 before `begins`, 1 from `ends` on.
  double at(double reduction) const;
};

/// When the hand lets go. The plates bear the weight of a breast long before friction between them
/// holds it against a pull.
struct Grip {
  Release weight, pull;
};
/// On the way to a reduction, which is a fraction.
Grip grip_before(double reduction);
/// Where a force or a pressure ends the path, whose reduction is not known beforehand: the hand lets
/// go of everything early.
Grip grip_before_any_force();

/// Nodal forces (µN, 3 a node) that pull the skin in front of the plates' edge away from the chest wall,
/// `newton` in all: a uniform traction that rises from zero over the 20 mm next to the edge. `x`:
/// positions, mm. Throws Error (input) when no skin lies in front of the edge.
Eigen::VectorXd pull_forwards(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate,
                              double newton);

/// A stage of positioning and what it did to the tissue at the edge of the plates.
struct PositioningStage {
  std::string name;  ///< upright, lifted, pulled, compressed
  double volume_in_front_percent = 0;
  /// Mean motion away from the chest wall, since the breast hung upright, of the tissue that then lay
  /// within 10 mm of the edge, mm.
  double past_edge_mm = 0;
};
/// `upright` and `x`: positions (3 a node, mm) of the breast as it hung and at the stage.
PositioningStage positioning_stage(std::string name, const HexMesh& mesh,
                                   const Eigen::VectorXd& upright, const Eigen::VectorXd& x,
                                   const Plate& plate);

}  // namespace breast
