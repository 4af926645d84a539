// SPDX-License-Identifier: GPL-3.0-or-later
// The linear systems of incompressible equilibrium (solve/saddle.hpp) over all ranks: PETSc's flexible
// GMRES, split by field: GAMG with rigid motions as near-null space for K + κBᵀM⁻¹B, and our stand-in
// for the pressure's Schur complement, solved by a few conjugate gradients.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "distributed/part_problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// Settings may be changed by PETSC_OPTIONS: of GMRES -breast_ksp_..., of GAMG
/// -breast_fieldsplit_u_pc_gamg_..., of the conjugate gradients -breast_schur_ksp_...
class PartSaddle {
 public:
  /// `problem` must outlive this.
  explicit PartSaddle(const PartProblem& problem);
  ~PartSaddle();
  PartSaddle(const PartSaddle&) = delete;
  PartSaddle& operator=(const PartSaddle&) = delete;

  /// Builds the levels; false on all ranks where a node's block is not positive definite.
  bool factorise(const SaddleMatrix& matrix, const Constraints& constraints);

  /// As SaddleSolver::solve, `imposed` (3 a node, may be empty) what held components move by.
  /// `most` iterations; `solved` false: not to the tolerance.
  SaddleStep solve(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                   const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed, double tolerance,
                   int most) const;

  /// A map on (u, p): u 3 a node in global axes, p by pressures. Its first result counts as the sum
  /// over ranks.
  using Map = std::function<void(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                 Eigen::VectorXd& top, Eigen::VectorXd& bottom)>;
  /// Solves map(u, p) = (top, bottom), preconditioned by the levels; rows of forces along held
  /// components are left out. `top` is complete. The map is near [K, −(1−κc)Bᵀ; B, cM].
  SaddleStep solve_near(const Map& map, const Eigen::VectorXd& top, const Eigen::VectorXd& bottom,
                        double tolerance, int most, double& residual) const;

  /// Whether the matrix of the last factorise is known to be positive definite: the lowest Ritz
  /// value of conjugate gradients with the levels.
  bool positive_definite() const;

  const Constraints& constraints() const { return constraints_; }
  int factorisations() const { return factorisations_; }
  /// Values kept on all ranks by K and by GAMG's levels, for reports.
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
