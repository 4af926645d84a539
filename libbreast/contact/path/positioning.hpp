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

/// The parts of the way to the target (part_of_way, 0 to 1) between which the hand releases a load.
struct Release {
  double begins = 0, ends = 0;

  /// Share of the load that the hand has released: 0 before `begins`, 1 from `ends` on.
  double at(double way) const;
};

/// When the hand releases the weight and the pull. The plates can carry the weight of a breast long
/// before friction can hold it against a pull. The way is that to the nearest target, so that a force
/// is not passed while the hand still holds on, however little the breast is compressed there.
struct Hand {
  Release weight{0.1, 0.5}, pull{0.5, 0.8};
  /// The hand has let go completely from this part of the way on.
  double gone_from() const { return pull.ends > weight.ends ? pull.ends : weight.ends; }
};

/// Nodal forces (µN, 3 per node) that pull the skin in front of the plates' edge away from the
/// chest wall with a total of `newton`: a uniform traction that rises from zero over the 20 mm next
/// to the edge. `x` are the positions in mm. Throws Error (input) if no skin lies in front of the
/// edge.
Eigen::VectorXd pull_forwards(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate,
                              double newton);

/// A stage of positioning and its effect on the tissue at the edge of the plates.
struct PositioningStage {
  std::string name;  ///< hanging, lifted, pulled, compressed
  double volume_in_front_percent = 0;
  /// Mean displacement away from the chest wall, relative to the shape about which the plates were
  /// placed, of the tissue that lay within 10 mm of the edge there, mm.
  double past_edge_mm = 0;
};
/// `start` and `x`: positions (3 per node, mm) of the shape about which the plates were placed, and at
/// this stage.
PositioningStage positioning_stage(std::string name, const HexMesh& mesh,
                                   const Eigen::VectorXd& start, const Eigen::VectorXd& x,
                                   const Plate& plate);

}  // namespace breast
