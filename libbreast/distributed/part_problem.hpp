// SPDX-License-Identifier: GPL-3.0-or-later
// The equilibrium problem of one part of a mesh: the terms of solve/ and mechanics/terms on its own
// elements and faces, and their sums over all ranks.
#pragma once

#include <memory>

#include "distributed/exchange.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/terms/dead_load.hpp"
#include "mechanics/terms/solid.hpp"
#include "solve/problem.hpp"

namespace breast {

/// |θ_e| / V_e of a solution, of equilibria and of the inverse problem.
inline constexpr double part_volume_tolerance = 1e-11;

/// Nodal vectors contain all nodes of the part; a shared node has the same value on all its ranks.
/// Pressure vectors contain the pressures of the part's own elements. Every member that returns a
/// sum is collective.
class PartProblem {
 public:
  /// Uses `options` with the multigrid solver and the augmentation that suits it. Both references
  /// must outlive this object. Throws a SharedError (input) if mesh and options do not fit
  /// together.
  PartProblem(const Ranks& ranks, const MeshPart& part, const MechanicsOptions& options);

  const Ranks& ranks() const { return ranks_; }
  const MeshPart& part() const { return part_; }
  const Exchange& exchange() const { return exchange_; }
  /// The terms of this part alone.
  const Problem& own() const { return *problem_; }
  const PressureSpace& pressures() const { return *solid_->space()->pressures; }
  State at_rest(const Eigen::VectorXd& shape) const {
    return {shape, shape, solid_->rest_pressure()};
  }

  /// Sets the nodal gravity forces of the imaged shape under `gravity` (mm/s²); set_load sets the
  /// part of them that acts (0 to 1).
  void set_gravity(const Vec3& gravity);
  void set_load(double part);
  /// Norm of the load with which residuals are compared, µN.
  double load_norm() const { return load_norm_; }

  /// Evaluates the forces, complete at every node of the part; θ of the part's own elements; and
  /// energy and extremes of the whole body, with bad_element numbered as in the whole mesh. What
  /// the request fills belongs to this part alone, except for the diagonal of the matrix, which is
  /// complete.
  Forces evaluate(const State& state, const Request& request) const;
  Forces forces(const State& state, const Eigen::VectorXd* kappa = nullptr) const;
  Constraints constraints_at(const Eigen::VectorXd& x) const { return problem_->constraints_at(x); }
  /// Moves sliding nodes back to their surface; returns false if a node has left it on any rank.
  bool restore(Eigen::VectorXd& x) const;

  /// Sum of a · b over the nodes of the body (3 entries per node).
  double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  /// Norm of the residual over unconstrained components, µN.
  double free_norm(const Constraints& held, const Forces& forces) const;
  double volume_residual(const Forces& forces) const;
  /// An element that is turned inside out, numbered as in the whole mesh; −1 if there is none.
  int folded_element(const State& state) const;
  /// Residual that rounding of the positions alone can cause, relative to the load.
  double rounding(const SaddleMatrix& matrix, const Eigen::VectorXd& x) const;

 private:
  int whole_element(bool known, int own) const;

  const Ranks& ranks_;
  const MeshPart& part_;
  Exchange exchange_;
  std::shared_ptr<const Solid> solid_;
  std::shared_ptr<DeadLoad> load_;
  std::unique_ptr<Problem> problem_;
  Eigen::VectorXd gravity_;  // nodal forces of this part's elements
  SupportEffects supports_;
  double stiffness_force_ = 1, load_norm_ = 1;
};

}  // namespace breast
