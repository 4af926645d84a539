// SPDX-License-Identifier: GPL-3.0-or-later
// Solver on several ranks for the linear systems of incompressible equilibrium (solve/saddle.hpp):
// PETSc's flexible GMRES with a block preconditioner. K + κBᵀM⁻¹B is preconditioned by GAMG with
// rigid motions as near-null space, and the pressure's Schur complement by our sparse
// approximation, which a few conjugate-gradient steps solve.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "distributed/exchange.hpp"
#include "mechanics/inverse_system.hpp"
#include "solve/discretisation.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// PETSC_OPTIONS can change the settings: those of GMRES begin with -breast_ksp_, those of GAMG
/// with -breast_fieldsplit_u_pc_gamg_, those of the conjugate gradients with -breast_schur_ksp_.
/// Every function is collective.
class PartSaddle final : public SaddleSolverBase {
 public:
  /// `space` is that of this part. Both must outlive this object.
  PartSaddle(const Exchange& exchange, const Discretisation& space);
  ~PartSaddle() override;
  PartSaddle(const PartSaddle&) = delete;
  PartSaddle& operator=(const PartSaddle&) = delete;

  /// Builds the multigrid levels, without a shift; fails on all ranks if the block of any node is not
  /// positive definite.
  Factorisation factorise(const SaddleMatrix& matrix, const Constraints& constraints,
                          bool may_shift = true) override;
  /// From the lowest Ritz value of conjugate gradients with the multigrid preconditioner.
  bool positive_definite() const override;
  LinearSolver kind() const override { return LinearSolver::multigrid; }

  /// Solves the linearised inverse problem, preconditioned by the multigrid levels.
  SolveReference solve_reference() const;

  /// Number of values stored on all ranks for K and for GAMG's levels, for reports.
  double matrix_values() const;
  double level_values() const;

 private:
  struct Impl;
  /// A linear map of (u, p): u has 3 entries per node in global axes, p one per pressure. The first
  /// result is understood as the sum over ranks.
  using Map = std::function<void(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                 Eigen::VectorXd& top, Eigen::VectorXd& bottom)>;
  /// Solves map(u, p) = (top, bottom), preconditioned by the multigrid levels; the force rows of
  /// constrained components are left out. `top` is complete at shared nodes. The map must be close
  /// to [K, −(1−κc)Bᵀ; B, cM].
  SaddleStep solve_near(const Map& map, const Eigen::VectorXd& top, const Eigen::VectorXd& bottom,
                        double tolerance, int most, double& residual) const;
  SaddleStep solve_imposed(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                           const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed,
                           double tolerance, int restarts) const override;

  std::unique_ptr<Impl> impl_;
};

}  // namespace breast
