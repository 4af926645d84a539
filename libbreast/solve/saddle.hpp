// SPDX-License-Identifier: GPL-3.0-or-later
// Solver for the linear systems of incompressible equilibrium (forward, backward, contact):
//
//     [ K  −Bᵀ ] [ δu ]   [ −r ]        r = ∂Π/∂u, θ = −∂Π/∂p, K = ∂r/∂u, B = ∂θ/∂u,
//     [ B   cM ] [ δp ] = [ −θ ]        M pressure mass, c = 1/bulk modulus (0: incompressible)
//
// solved through the positive definite K + κ Bᵀ M⁻¹ B (element-local, hence with the pattern of K):
// directly, by its Cholesky factor and a few conjugate-gradient iterations on the pressure; or, for
// meshes whose factor is too large, by GMRES preconditioned with a multigrid cycle and a sparse
// approximation of the pressure's Schur complement (κ is then three times the shear modulus instead
// of a thousand times). Example:
//
//     SaddleSolver solver(pattern);                    // ordering and analysis, once per mesh
//     problem.tangent(state, forces, matrix);          // fills a SaddleMatrix
//     solver.factorise(matrix, constraints);           // constraints may change every time
//     SaddleStep step = solver.solve(matrix, r, theta);// increments imposed exactly
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solve/constraints.hpp"
#include "solve/direct/cholesky.hpp"
#include "solve/multigrid/multigrid.hpp"
#include "solve/multigrid/pressure_schur.hpp"
#include "solve/node_matrix.hpp"
#include "solve/saddle_matrix.hpp"

namespace breast {

enum class LinearSolver { direct, multigrid };

/// GMRES stores two vectors per iteration; after `gmres_restart` iterations it restarts from its current
/// result, at most `gmres_restarts` times before it gives up.
inline constexpr int gmres_restart = 60, gmres_restarts = 6;
/// GMRES measures forces and volumes together, by this part of the tolerance of the volumes.
inline constexpr double gmres_part_of_tolerance = 0.1;
/// Steps of the iteration that shows whether a matrix is positive definite.
inline constexpr int most_definite_steps = 100;

struct Factorisation {
  bool ok = false;
  double shift =
      0;  ///< multiple of SaddleMatrix::diagonal that was added; 0 if K + κBᵀM⁻¹B was definite
  int attempts = 0;  ///< numerical factorisations
};

struct SaddleStep {
  Eigen::VectorXd u, p;  ///< increments, global axes
  int iterations = 0;    ///< iterations of the conjugate gradients on the pressure, or of GMRES
  bool solved = true;    ///< whether the tolerance was reached
};

/// What Newton's method asks of a linear solver.
class SaddleSolverBase {
 public:
  virtual ~SaddleSolverBase() = default;

  /// Imposes the constraints exactly (rotated axes, scaled identity: the pattern never changes) and
  /// factorises. If the matrix is not positive definite, a small multiple of SaddleMatrix::diagonal
  /// is added: starting from an eighth of the last shift that was needed, it is increased by
  /// factors of 8. If `may_shift` is false, it fails instead. With multigrid the levels are built
  /// instead, and only an indefinite direction in a coarse space is noticed: see positive_definite.
  virtual Factorisation factorise(const SaddleMatrix& matrix, const Constraints& constraints,
                                  bool may_shift = true) = 0;
  /// Solves for the increments; `tolerance` is the relative residual of the volume equation (with
  /// multigrid, a tenth of it is that of both equations). `matrix` and the constraints must be
  /// those of the last factorise, except for the prescribed increments. GMRES gives up after
  /// `restarts` times 60 iterations.
  SaddleStep solve(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                   const Eigen::VectorXd& theta, double tolerance = 1e-6,
                   int restarts = gmres_restarts) const;
  /// The change of positions that is smallest in the norm of K among those that move held
  /// components by `imposed` (3 per node, in the span of the constraints) and change the volumes by
  /// −theta.
  Eigen::VectorXd correction(const SaddleMatrix& matrix, const Eigen::VectorXd& imposed,
                             const Eigen::VectorXd& theta, double tolerance) const;
  /// Whether the matrix of the last factorise is positive definite: from the Cholesky
  /// factorisation, or with multigrid from the lowest eigenvalue of cycle times matrix (Lanczos).
  /// Also false if that is too close to zero to decide.
  virtual bool positive_definite() const = 0;
  virtual LinearSolver kind() const = 0;

  const Constraints& constraints() const { return constraints_; }
  /// Numerical factorisations (multigrid: constructions of the levels) so far.
  int factorisations() const { return factorisations_; }

 protected:
  explicit SaddleSolverBase(int nodes) : constraints_(nodes) {}

  /// `solve` with the increments of constrained components (3 per node), which may be empty if none
  /// moves.
  virtual SaddleStep solve_imposed(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                                   const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed,
                                   double tolerance, int restarts) const = 0;

  Constraints constraints_;  // of the last factorise
  int factorisations_ = 0;
};

/// The solver of a body in one piece.
class SaddleSolver final : public SaddleSolverBase {
 public:
  explicit SaddleSolver(const std::shared_ptr<const NodePattern>& pattern,
                        LinearSolver kind = LinearSolver::direct);

  Factorisation factorise(const SaddleMatrix& matrix, const Constraints& constraints,
                          bool may_shift = true) override;
  bool positive_definite() const override;
  LinearSolver kind() const override { return kind_; }

  /// (K + κBᵀM⁻¹B)⁻¹ v on the free part, held components zero. With multigrid this is one cycle, a
  /// symmetric positive definite approximation.
  Eigen::VectorXd back_solve(const Eigen::VectorXd& v) const;

  /// Approximation of S⁻¹ q for the pressure's Schur complement S = (1 − κc) B K_κ⁻¹ Bᵀ + cM of
  /// `matrix`: κM⁻¹q with a factor; with multigrid that of the last factorise, which is not a fixed
  /// linear map.
  Eigen::VectorXd schur_solve(const SaddleMatrix& matrix, const Eigen::VectorXd& q) const;

  /// Stored values and GFlop of one factorisation; with multigrid the values of all levels, and
  /// zero.
  double factor_entries() const;
  double factor_gflop() const;

 private:
  void impose(const SaddleMatrix& matrix);
  SaddleStep solve_imposed(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                           const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed,
                           double tolerance, int restarts) const override;
  SaddleStep solve_by_factor(const SaddleMatrix& matrix, const Eigen::VectorXd& right,
                             const Eigen::VectorXd& imposed, const Eigen::VectorXd& theta,
                             double tolerance) const;
  SaddleStep solve_by_cycles(const SaddleMatrix& matrix, const Eigen::VectorXd& right,
                             const Eigen::VectorXd& imposed, const Eigen::VectorXd& theta,
                             double tolerance, int restarts) const;

  LinearSolver kind_;
  std::unique_ptr<Cholesky> cholesky_;
  Multigrid multigrid_;
  PressureSchur schur_;
  NodeMatrix work_;
  double last_shift_ = 0;
  bool definite_ = false;  // the last factorise succeeded without a shift
};

}  // namespace breast
