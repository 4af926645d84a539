// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction between skin and plate as a term, by a return map. A node is tied to an anchor
// on the plate by a stiff tangential spring; where the spring force would exceed μ times the normal
// force, the anchor slides with the node. The spring replaces exact sticking: the slip that it
// allows is the friction force divided by its stiffness. For a given bound (Tresca friction) the
// force is the gradient of a convex energy; the caller updates Coulomb's bound.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "contact/plates.hpp"
#include "solve/term.hpp"

namespace breast {

/// Friction of a plate on one node.
struct FrictionForce {
  Vec3 force{0, 0, 0};            ///< on the node, perpendicular to the plate's normal, µN
  Mat3 stiffness = Mat3::Zero();  ///< −∂force/∂x at a fixed bound and normal, symmetric, µN/mm
  double energy = 0;              ///< nJ
  bool slips = false;
};

struct Friction {
  double coefficient = 0;  ///< μ; 0: none
  /// Slip at which friction is fully developed, mm: the anchor springs of a node have the stiffness
  /// bound/slip. With one stiffness for all nodes, the slip would depend on material, mesh and
  /// pressure.
  double slip = 0.5;

  bool present() const { return coefficient > 0; }
  /// Largest friction force under this normal force, µN; zero in tension.
  double bound(double pressed) const { return pressed > 0 ? coefficient * pressed : 0; }
  /// Stiffness of a node's spring, µN/mm, for the largest friction force `bound`, µN.
  double stick(double bound) const { return bound / slip; }
};

/// `x` and `anchor`: positions of the node and its anchor, mm; `normal`: unit normal of the plate
/// at x; `bound`, µN; `stick`, µN/mm.
FrictionForce friction_force(const Vec3& x, const Vec3& anchor, const Vec3& normal, double bound,
                             double stick);

/// A node that is held by the friction of a plate.
struct FrictionEntry {
  int node = 0;
  int plate = 0;         ///< 0 paddle, 1 detector
  Vec3 anchor{0, 0, 0};  ///< mm, where the plate is now
  double bound = 0;      ///< µN
  double stick = 0;      ///< µN/mm
  /// Normal of the plate, fixed during a solve; if absent, the normal at the node's present position.
  std::optional<Vec3> normal = {};
};

/// Restores the normal of a recorded entry as far as its force needs it. The anchor was recorded in the plane through the
/// node at `x` (mm) that is perpendicular to the normal of the solve (anchor_in_plane). The result is, of the normals
/// that are perpendicular to the line from `anchor` (mm) to `x`, the nearest to the plate's own normal there, which points
/// elsewhere where the node lies deep in a rounded edge. It gives the same force; the stiffness may differ.
Vec3 kept_normal(const Plate& plate, const Vec3& anchor, const Vec3& x);

/// With fixed normals the tangent is exact and the force has an energy. Without, the tangent neglects
/// the rotation of the normal with the node, and the full one would not be symmetric: on a rounded
/// edge the error grows with the distance of the anchor from the tangential plane, and Newton's
/// method may cycle.
class FrictionTerm final : public Term {
 public:
  void set_plates(const PlatePair& plates) { plates_ = plates; }
  void set_entries(std::vector<FrictionEntry> entries);
  const std::vector<FrictionEntry>& entries() const { return entries_; }
  const PlatePair& plates() const { return plates_; }
  FrictionForce at(const FrictionEntry& entry, const Eigen::VectorXd& x) const;
  /// Where the node is anchored after the solution x, mm: behind a slipping node by its full slip.
  Vec3 next_anchor(const FrictionEntry& entry, const Eigen::VectorXd& x) const;
  /// The anchor moved along the normal into the tangential plane of the node, which changes no force.
  Vec3 anchor_in_plane(const FrictionEntry& entry, const Eigen::VectorXd& x) const;

  /// Change of the forces on the nodes (µN, 3 per node) while the plates move and carry the anchors
  /// with them by velocity(plate, x), mm per unit; bounds and slipping nodes are kept.
  Eigen::VectorXd change_of_forces(
      const Eigen::VectorXd& x, int plate,
      const std::function<Vec3(int plate, const Vec3& x)>& velocity) const;

  std::string name() const override { return "friction"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override;

 private:
  PlatePair plates_;
  std::vector<FrictionEntry> entries_;
  Cells cells_;  // one node each

  Vec3 normal_at(const FrictionEntry& entry, const Vec3& point) const;
};

}  // namespace breast
