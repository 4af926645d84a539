// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction between skin and plate as a term: a return map. A node is tied to an anchor on
// the plate by a stiff spring along the plate; where the spring would pull more than μ times the
// normal force the anchor slides after the node. The spring stands for exact sticking: the slip it
// allows is the friction force over its stiffness. With the bound given (Tresca's friction) it is
// the gradient of a convex energy; Coulomb's bound is followed from outside.
#pragma once

#include <functional>
#include <vector>

#include "contact/plates.hpp"
#include "solve/term.hpp"

namespace breast {

/// Friction of a plate on one node.
struct FrictionForce {
  Vec3 force{0, 0, 0};            ///< on the node, at right angles to the plate's normal, µN
  Mat3 stiffness = Mat3::Zero();  ///< −∂force/∂x at a fixed bound and normal, symmetric, µN/mm
  double energy = 0;              ///< nJ
  bool slips = false;
};

struct Friction {
  double coefficient = 0;  ///< μ; 0: none
  double stick = 0;        ///< stiffness of the anchor springs, µN/mm per node

  bool present() const { return coefficient > 0; }
  /// The most a plate that presses with this normal force holds, µN; nothing where it pulls.
  double bound(double pressed) const { return pressed > 0 ? coefficient * pressed : 0; }
};

/// `x` and `anchor`: the node and what holds it, mm; `normal`: unit, of the plate at x; `bound`, µN;
/// `stick`, µN/mm.
FrictionForce friction_force(const Vec3& x, const Vec3& anchor, const Vec3& normal, double bound,
                             double stick);

/// A node that a plate holds.
struct FrictionEntry {
  int node = 0;
  int plate = 0;           ///< 0 paddle, 1 detector
  Vec3 anchor{0, 0, 0};    ///< mm, where the plate is now
  double bound = 0;        ///< µN
  double stick = 0;        ///< µN/mm
};

/// The tangent leaves out how the plate's normal turns with the node: exact on a flat plate, and on
/// a rounded edge as good as the step is short. The full one would not be symmetric.
class FrictionTerm final : public Term {
 public:
  void set_plates(const PlatePair& plates) { plates_ = plates; }
  void set_entries(std::vector<FrictionEntry> entries);
  const std::vector<FrictionEntry>& entries() const { return entries_; }
  const PlatePair& plates() const { return plates_; }
  FrictionForce at(const FrictionEntry& entry, const Eigen::VectorXd& x) const;

  /// Change of the forces on the nodes (µN, 3 a node) while the plates move, what holds the nodes moving
  /// with them by velocity(plate, x), mm per unit; bounds and slipping nodes stay.
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
};

}  // namespace breast
