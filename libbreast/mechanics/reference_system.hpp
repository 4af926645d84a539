// SPDX-License-Identifier: GPL-3.0-or-later
// The linearised inverse problem, the stress-free shape X unknown and the deformed shape given:
//
//     [ K_X  −Bᵀ ] [ δX ]   [ f ]
//     [ B_X   cM ] [ δp ] = [ v ]
//
// and its transpose, by GMRES on the factor of the forward problem: near F = 1 moving X one way is
// moving x the other way.
#pragma once

#include <Eigen/Core>

#include "solve/reference_tangent.hpp"
#include "solve/saddle.hpp"

namespace breast {

struct ReferenceStep {
  Eigen::VectorXd x, p;
  int iterations = 0;   ///< of GMRES
  double residual = 0;  ///< relative; not finite when it broke down
};

class ReferenceSystem {
 public:
  /// `solver` holds the factor of `matrix` under its constraints, which may be of a state near that
  /// of `tangent`: it only preconditions. `moved` are the constraints of δX, those of the solver but
  /// where nodes slide on a surface: they follow its normals at X. All must outlive this. `size` is a typical element edge
  /// (mm): it makes forces of volumes, so that one norm measures both.
  ReferenceSystem(const SaddleMatrix& matrix, const ReferenceTangent& tangent,
                  const SaddleSolver& solver, const Constraints& moved, double size);

  /// Held components of f are ignored, of δX zero.
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
