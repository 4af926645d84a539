// SPDX-License-Identifier: GPL-3.0-or-later
// The equilibrium problem of one part of a mesh: the terms of solve/ and mechanics/terms over its own
// elements and faces, and their sums over all ranks.
#pragma once

#include <memory>

#include "distributed/exchange.hpp"
#include "mechanics/terms/dead_load.hpp"
#include "mechanics/terms/solid.hpp"
#include "solve/problem.hpp"

namespace breast {

/// Vectors per node hold all nodes of the part, shared ones with the same value on all their ranks;
/// vectors per pressure those of its own elements. Every member that returns a sum is collective.
class PartProblem {
 public:
  /// `options` with the solver multigrid, whose augmentation suits it. Both references must outlive
  /// this. Throws a SharedError (input) when mesh and options do not fit.
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

  /// Nodal gravity forces of the imaged shape under `gravity` (mm/s²), and the part of them that acts.
  void set_gravity(const Vec3& gravity);
  void set_load(double part);
  /// Norm that residuals are compared with, µN.
  double load_norm() const { return load_norm_; }

  /// Forces complete at every node of the part; θ of its own elements; energy and extremes of the
  /// whole body, bad_element numbered as in the whole mesh. What the request fills is of this part
  /// alone, but the matrix's diagonal, which is complete.
  Forces evaluate(const State& state, const Request& request) const;
  Forces forces(const State& state, const Eigen::VectorXd* kappa = nullptr) const;
  Constraints constraints_at(const Eigen::VectorXd& x) const { return problem_->constraints_at(x); }
  /// Puts sliding nodes back on their surface; false: one has left it on some rank.
  bool restore(Eigen::VectorXd& x) const;

  /// Sum over the nodes of the body of a · b (3 per node).
  double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  /// ‖r‖ on what is not held, µN.
  double free_norm(const Constraints& held, const Forces& forces) const;
  double volume_residual(const Forces& forces) const;
  /// An element that is turned inside out, as in the whole mesh; −1: none.
  int folded_element(const State& state) const;
  /// Force that rounding the positions alone can make, relative to the load.
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
  double stiffness_force_ = 1, load_norm_ = 1;
};

}  // namespace breast
