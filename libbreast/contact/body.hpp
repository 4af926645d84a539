// What the contact solver needs of the body between the plates: forces and a linearised solve at a
// state, with normal increments prescribed at contact nodes. It knows neither laws nor elements.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Positions x (3 per node, mm) and element pressures p (Pa).
struct BodyState {
  Eigen::VectorXd x, p;
};

/// Forces of a state. `residual` is internal minus external force per degree of freedom, µN: zero
/// at free nodes in equilibrium, the reaction at fixed nodes, the plate's force at touching nodes.
struct BodyForces {
  Eigen::VectorXd residual;
  /// Gradient of the energy whose tangent is solved with, the volume error penalised; empty when it
  /// is the residual itself.
  Eigen::VectorXd augmented;
  double min_det_F = 1, max_det_F = 1;
  double max_volume_error = 0;  ///< worst |mean det F − 1| over elements
  /// Worst remainder of the volume equation over an element's volume: zero in a solution, where a
  /// compressible body still has a volume error.
  double volume_residual = 0;
};

/// Displacement of a node along a unit normal, prescribed in a linearised solve.
struct NormalConstraint {
  int node = 0;
  Vec3 normal{0, 0, 1};
  double increment = 0;  ///< mm
};

/// Outcome of a linearised solve.
struct BodySolve {
  bool ok = false;
  bool shifted = false;  ///< the constrained tangent was indefinite and was shifted to be solved
  double slope = 0;      ///< δxᵀ K δx with the tangent solved with: the descent promised
};

class ContactBody {
 public:
  virtual ~ContactBody() = default;
  virtual int nodes() const = 0;
  /// Sets the held components (chest wall, fixed cut) of a vector of 3 per node to zero.
  virtual void remove_held(Eigen::VectorXd& v) const = 0;
  /// Size of the external load, µN: the scale of the residual while no plate touches.
  virtual double load_norm() const = 0;
  /// Sum of the external forces on the body, µN.
  virtual Vec3 weight() const = 0;
  /// Forces of a state. False when the state is inadmissible (a folded element, a law out of
  /// range).
  virtual bool forces(const BodyState& state, BodyForces& forces) = 0;
  /// Assembles the tangent at a state, to be used by add_to_tangent and solve. False as above.
  virtual bool assemble(const BodyState& state) = 0;
  /// Adds a symmetric 3×3 block (µN/mm) to the tangent at a node.
  virtual void add_to_tangent(int node, const Mat3& block) = 0;
  /// Newton increment: minus `residual` balanced at all free degrees of freedom but the constrained
  /// normals, which move by the prescribed amount; the volume constraint linearised at the state.
  virtual BodySolve solve(const std::vector<NormalConstraint>& constraints,
                          const Eigen::VectorXd& residual, BodyState& increment) = 0;
};

}  // namespace breast
