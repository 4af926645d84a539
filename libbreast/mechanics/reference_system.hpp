// SPDX-License-Identifier: GPL-3.0-or-later
// The linearised inverse problem, in which the deformed shape is given and the stress-free shape X
// is unknown:
//
//     [ K_X  −Bᵀ ] [ δX ]   [ f ]
//     [ B_X   cM ] [ δp ] = [ v ]
//
// and its transpose, by GMRES preconditioned with the factor of the forward problem: near F = 1,
// moving X in one direction is equivalent to moving x in the opposite one.
#pragma once

#include <Eigen/Core>

#include "solve/reference_tangent.hpp"
#include "solve/saddle.hpp"

namespace breast {

struct ReferenceStep {
  Eigen::VectorXd x, p;
  int iterations = 0;   ///< of GMRES
  double residual = 0;  ///< relative residual; not finite if GMRES broke down
};

class ReferenceSystem {
 public:
  /// `solver` has the factor of `matrix` under its constraints, possibly of a state near that of
  /// `tangent`, since it is only the preconditioner. `moved` are the constraints of δX: those of
  /// the solver, except that nodes which slide on a surface follow its normals at X. All must
  /// outlive this. `size` is a typical element edge (mm): it converts volumes to forces, so that
  /// one norm measures both.
  ReferenceSystem(const SaddleMatrix& matrix, const ReferenceTangent& tangent,
                  const SaddleSolver& solver, const Constraints& moved, double size);

  /// Held components of f are ignored; those of δX are zero.
  ReferenceStep solve(const Eigen::VectorXd& f, const Eigen::VectorXd& v, double tolerance,
                      int max_iterations) const;
  /// The transposed system, [K_Xᵀ B_Xᵀ; −B cM], with right-hand side (f, v).
  ReferenceStep solve_transposed(const Eigen::VectorXd& f, const Eigen::VectorXd& v,
                                 double tolerance, int max_iterations) const;

 private:
  ReferenceStep run(bool transposed, const Eigen::VectorXd& f, const Eigen::VectorXd& v,
                    double tolerance, int max_iterations) const;
  Eigen::VectorXd apply(bool transposed, const Eigen::VectorXd& z) const;
  Eigen::VectorXd precondition(const Eigen::VectorXd& y) const;

  const SaddleMatrix& matrix_;
  const ReferenceTangent& tangent_;
  const SaddleSolver& solver_;
  const Constraints& moved_;
  double weigh_;
};

}  // namespace breast
