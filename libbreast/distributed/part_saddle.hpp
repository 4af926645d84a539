// SPDX-License-Identifier: GPL-3.0-or-later
// Solver on several ranks for the linear systems of incompressible equilibrium (solve/saddle.hpp):
// PETSc's flexible GMRES with a block preconditioner. K + κBᵀM⁻¹B is preconditioned by GAMG with
// rigid motions as near-null space, and the pressure's Schur complement by our sparse
// approximation, which a few conjugate-gradient steps solve.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "distributed/part_problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// PETSC_OPTIONS can change the settings: those of GMRES begin with -breast_ksp_, those of GAMG
/// with -breast_fieldsplit_u_pc_gamg_, those of the conjugate gradients with -breast_schur_ksp_.
class PartSaddle {
 public:
  /// `problem` must outlive this object.
  explicit PartSaddle(const PartProblem& problem);
  ~PartSaddle();
  PartSaddle(const PartSaddle&) = delete;
  PartSaddle& operator=(const PartSaddle&) = delete;

  /// Builds the multigrid levels; returns false on all ranks if the block of any node is not
  /// positive definite.
  bool factorise(const SaddleMatrix& matrix, const Constraints& constraints);

  /// Solves like SaddleSolver::solve. `imposed` (3 entries per node, may be empty) are the
  /// increments of constrained components. `most` limits the iterations; `solved` is false if the
  /// tolerance was not reached.
  SaddleStep solve(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                   const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed, double tolerance,
                   int most) const;

  /// A linear map of (u, p): u has 3 entries per node in global axes, p one per pressure. The first
  /// result is understood as the sum over ranks.
  using Map = std::function<void(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                 Eigen::VectorXd& top, Eigen::VectorXd& bottom)>;
  /// Solves map(u, p) = (top, bottom), preconditioned by the multigrid levels; the force rows of
  /// constrained components are left out. `top` is complete at shared nodes. The map must be close
  /// to [K, −(1−κc)Bᵀ; B, cM].
  SaddleStep solve_near(const Map& map, const Eigen::VectorXd& top, const Eigen::VectorXd& bottom,
                        double tolerance, int most, double& residual) const;

  /// Whether the matrix of the last call of factorise is found to be positive definite, from the
  /// lowest Ritz value of conjugate gradients with the multigrid preconditioner.
  bool positive_definite() const;

  const Constraints& constraints() const { return constraints_; }
  int factorisations() const { return factorisations_; }
  /// Number of values stored on all ranks for K and for GAMG's levels, for reports.
  double matrix_values() const;
  double level_values() const;

 private:
  struct Impl;
  const PartProblem& problem_;
  Constraints constraints_;
  std::unique_ptr<Impl> impl_;
  int factorisations_ = 0;
};

}  // namespace breast
