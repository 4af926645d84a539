// SPDX-License-Identifier: GPL-3.0-or-later
// An equilibrium problem: terms plus constraints.
//
//     Problem problem = scene.problem(...);       // or add() terms to one
//     SaddleMatrix matrix = problem.make_matrix();
//     SaddleSolver solver(problem.space().pattern);
//     State state{X, x, p};
//     NewtonResult result = equilibrate(problem, solver, matrix, state);   // solve/equilibrate.hpp
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "solve/constraints.hpp"
#include "solve/discretisation.hpp"
#include "solve/sharing.hpp"
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
  /// The constraints that do not depend on where the body is.
  const Constraints& constraints() const { return constraints_; }
  void set_constraints(Constraints constraints) { constraints_ = std::move(constraints); }
  /// Nodes that slide on a surface; null if there are none.
  void set_sliding(std::shared_ptr<const SlidingNodes> sliding) { sliding_ = std::move(sliding); }
  const SlidingNodes* sliding() const { return sliding_.get(); }
  /// Makes this the part of a body that several processes solve together: forces, norms and
  /// decisions are those of the whole body, and every function that returns one is collective. What a
  /// request fills belongs to this part alone, except for the diagonal of the matrix.
  void share(std::shared_ptr<const Sharing> sharing) { sharing_ = std::move(sharing); }

  /// All constraints of an increment at positions x: the fixed ones, and the normals of sliding
  /// nodes.
  Constraints constraints_at(const Eigen::VectorXd& x) const;
  /// Moves sliding nodes back to their surface. Returns a node that has left it, or −1.
  int restore(Eigen::VectorXd& x) const;
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
  /// ‖r‖ over the components that are not held, µN.
  double free_norm(const Constraints& held, const Forces& forces) const;
  /// Worst |θ| of an element over its volume in the imaged shape: zero in a solution,
  /// also of a compressible body, whose volume does change.
  double volume_residual(const Forces& forces) const;
  /// An element that is not positive in both shapes at its nodes and quadrature points; −1: none.
  /// A state with such an element is not accepted.
  int folded_element(const State& state) const;
  /// Force (µN) that rounding of the positions alone can cause, below which no residual can be
  /// reduced reliably.
  double rounding_force(const SaddleMatrix& matrix, const Eigen::VectorXd& x) const;

  /// Over the whole body: sums, the largest value, agreement; products and norms of complete nodal
  /// values (3 per node).
  double sum(double mine) const { return sharing_ ? sharing_->sum(mine) : mine; }
  double most(double mine) const { return sharing_ ? sharing_->most(mine) : mine; }
  bool all(bool mine) const { return sharing_ ? sharing_->all(mine) : mine; }
  double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    return sharing_ ? sharing_->dot(a, b) : a.dot(b);
  }
  double norm(const Eigen::VectorXd& v) const {
    return sharing_ ? std::sqrt(sharing_->dot(v, v)) : v.norm();
  }
  /// Makes nodal values complete, to which every process has contributed its part.
  void complete(Eigen::VectorXd& nodal) const {
    if (sharing_) sharing_->complete(nodal);
  }

 private:
  Forces evaluate_terms(const State& state, const Request& request) const;
  void agree(const Request& request, Forces& forces) const;

  std::shared_ptr<const Discretisation> space_;
  Constraints constraints_;
  std::shared_ptr<const SlidingNodes> sliding_;
  std::vector<std::shared_ptr<const Term>> terms_;
  std::shared_ptr<const Sharing> sharing_;  // null: the body is in one piece
  double load_norm_ = 1;
};

}  // namespace breast
