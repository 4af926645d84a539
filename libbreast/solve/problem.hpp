// SPDX-License-Identifier: GPL-3.0-or-later
// An equilibrium problem: terms plus constraints.
//
//     Problem problem = scene.problem(...);       // or add() terms to one
//     SaddleMatrix matrix = problem.make_matrix();
//     SaddleSolver solver(problem.space().pattern);
//     State state{X, x, p};
//     NewtonResult result = equilibrate(problem, solver, matrix, state);   // solve/equilibrate.hpp
#pragma once

#include <memory>
#include <vector>

#include "solve/constraints.hpp"
#include "solve/discretisation.hpp"
#include "solve/sliding_nodes.hpp"
#include "solve/term.hpp"

namespace breast {

class Problem {
 public:
  /// A problem without terms, with unknowns of which `constraints` fixes some.
  Problem(std::shared_ptr<const Discretisation> space, Constraints constraints);

  void add(std::shared_ptr<const Term> term);
  const std::vector<std::shared_ptr<const Term>>& terms() const { return terms_; }
  const Discretisation& space() const { return *space_; }
  const std::shared_ptr<const Discretisation>& shared_space() const { return space_; }
  /// The constraints that do not depend on where the body is.
  const Constraints& constraints() const { return constraints_; }
  void set_constraints(Constraints constraints) { constraints_ = std::move(constraints); }
  /// Nodes that slide on a surface; null if there are none.
  void set_sliding(std::shared_ptr<const SlidingNodes> sliding) { sliding_ = std::move(sliding); }
  const SlidingNodes* sliding() const { return sliding_.get(); }
  /// All constraints of an increment at positions x: the fixed ones, and the normals of sliding
  /// nodes.
  Constraints constraints_at(const Eigen::VectorXd& x) const;
  /// Moves sliding nodes back to their surface. Returns a node that has left it, or −1.
  int restore(Eigen::VectorXd& x) const { return sliding_ ? sliding_->restore(x) : -1; }
  int nodes() const { return space_->nodes(); }
  SaddleMatrix make_matrix() const { return space_->make_matrix(); }

  /// Evaluates all terms in one pass. At an invalid state it stops at once, and the request's
  /// targets are undefined.
  Forces evaluate(const State& state, const Request& request) const;
  /// The forces without a tangent; `kappa` (per element) may be null.
  Forces forces(const State& state, const Eigen::VectorXd* kappa = nullptr) const;
  /// Computes forces and tangent together. Returns false (and forces.valid is false) at an
  /// inadmissible state.
  bool tangent(const State& state, Forces& forces, SaddleMatrix& matrix) const;

  /// Norm with which the residual is compared, µN: that of the external load, or its substitute.
  double load_norm() const { return load_norm_; }
  void set_load_norm(double norm) { load_norm_ = norm; }
  /// ‖r‖ over the components that are not held at the positions x, µN.
  double free_norm(const Eigen::VectorXd& x, const Forces& forces) const {
    return free_norm(constraints_at(x), forces);
  }
  /// The same where the constraints at the positions are known.
  static double free_norm(const Constraints& held, const Forces& forces);
  /// Worst |θ| of an element over its volume in the imaged shape: zero in a solution,
  /// also of a compressible body, whose volume does change.
  double volume_residual(const Forces& forces) const;
  /// An element that is not positive in both shapes at its corners and quadrature points; −1: none.
  /// A state with such an element is not accepted.
  int folded_element(const State& state) const;

 private:
  std::shared_ptr<const Discretisation> space_;
  Constraints constraints_;
  std::shared_ptr<const SlidingNodes> sliding_;
  std::vector<std::shared_ptr<const Term>> terms_;
  double load_norm_ = 1;
};

}  // namespace breast
