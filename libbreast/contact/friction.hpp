// Coulomb friction between skin and plate: a return map. A node is tied to an anchor on the plate
// by a stiff spring along the plate; where the spring would pull more than μ times the normal force
// the anchor slides after the node. The spring stands for exact sticking: the slip it allows is the
// friction force over its stiffness. With the bound given (Tresca's friction) it is the gradient of
// a convex energy; Coulomb's bound is followed from outside.
#pragma once

#include "contact/plates.hpp"

namespace breast {

/// Friction of a plate on one node.
struct FrictionForce {
  Vec3 force{0, 0, 0};            ///< on the node, at right angles to the plate's normal, µN
  Mat3 stiffness = Mat3::Zero();  ///< −∂force/∂x at a fixed bound, symmetric, µN/mm
  bool slips = false;
};

struct Friction {
  double coefficient = 0;  ///< μ; 0: none
  double stick = 0;        ///< stiffness of the anchor springs, µN/mm per node

  bool present() const { return coefficient > 0; }
  /// The most a plate that presses with this normal force holds, µN; nothing where it pulls.
  double bound(double pressed) const { return pressed > 0 ? coefficient * pressed : 0; }
  /// `x` and `anchor`: the node and what holds it, mm; `normal`: unit, of the plate at x; `bound`,
  /// µN.
  FrictionForce at(const Vec3& x, const Vec3& anchor, const Vec3& normal, double bound) const;
  /// Where the anchor ends in an equilibrium with this force.
  Vec3 slid_anchor(const Vec3& x, const FrictionForce& at) const { return x + at.force / stick; }
};

}  // namespace breast
