// The linear systems of incompressible equilibrium, for whoever builds on them (forward, backward,
// contact):
//
//     [ K  −Bᵀ ] [ δu ]   [ −r ]        r = ∂Π/∂u, θ = −∂Π/∂p, K = ∂r/∂u, B = ∂θ/∂u, M pressure
//     mass, [ B   cM ] [ δp ] = [ −θ ]        c = 1/bulk modulus (0: exactly incompressible)
//
// solved through the positive definite K + κ Bᵀ M⁻¹ B (element-local, so with the pattern of K):
// directly, by its Cholesky factor and a few conjugate-gradient iterations on the pressure; or, for
// meshes whose factor is not affordable, by GMRES preconditioned with a multigrid cycle (κ then is
// about ten times the shear modulus instead of a thousand). Use:
//
//     SaddleSolver solver(pattern);                    // ordering and analysis, once per mesh
//     scene.tangent(state, matrix);                    // fills a SaddleMatrix
//     matrix.stiffness.add_to_node(n, block);          // optional extra terms (contact curvature)
//     solver.factorise(matrix, constraints);           // constraints may change every time
//     SaddleStep step = solver.solve(matrix, r, theta);// increments imposed exactly
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solve/cholesky.hpp"
#include "solve/constraints.hpp"
#include "solve/multigrid.hpp"
#include "solve/node_matrix.hpp"

namespace breast {

/// Dense rows per element against its nodes: B, and its sibling ∂θ/∂X.
struct ElementRows {
  const Cells* cells = nullptr;
  int rows = 0;                ///< pressures per element: 1 or 4
  std::vector<double> values;  ///< per element rows × 3n, column-major

  void resize(const Cells& over, int rows_per_element);
  Eigen::Map<const Eigen::MatrixXd> at(int element) const;
  Eigen::Map<Eigen::MatrixXd> at(int element);
  Eigen::VectorXd apply(const Eigen::VectorXd& u) const;            ///< B u
  Eigen::VectorXd apply_transpose(const Eigen::VectorXd& p) const;  ///< Bᵀ p
};

/// What does not change with the state: M⁻¹ per element (rows × rows) and c = 1/bulk modulus.
struct PressureSpace {
  int rows = 0;
  std::vector<double> mass, inverse_mass;  ///< per element rows × rows
  Eigen::VectorXd compliance;              ///< c per element, 1/Pa
  int elements() const { return int(compliance.size()); }
  Eigen::Map<const Eigen::MatrixXd> mass_at(int e) const;
  Eigen::Map<const Eigen::MatrixXd> inverse_at(int e) const;
  /// s_e M_e q_e or s_e M_e⁻¹ q_e with one factor s per element.
  Eigen::VectorXd multiply(const Eigen::VectorXd& q, const Eigen::VectorXd& factor) const;
  Eigen::VectorXd divide(const Eigen::VectorXd& q, const Eigen::VectorXd& factor) const;
};

struct SaddleMatrix {
  NodeMatrix stiffness;      ///< K + κ Bᵀ M⁻¹ B, global axes, without constraints
  ElementRows divergence;    ///< B
  Eigen::VectorXd kappa;     ///< κ per element, Pa
  Eigen::VectorXd diagonal;  ///< of K without κ, made positive: the measure of a shift
  std::shared_ptr<const PressureSpace> space;
  Eigen::VectorXd positions;  ///< of the nodes, mm: rigid motions for a multigrid

  /// K u without the κ term (for reactions and bordering).
  Eigen::VectorXd multiply_unaugmented(const Eigen::VectorXd& u) const;
};

enum class LinearSolver { direct, multigrid };

struct Factorisation {
  bool ok = false;
  double shift = 0;  ///< added, relative to SaddleMatrix::diagonal; 0: K + κBᵀM⁻¹B was definite
  int attempts = 0;  ///< numerical factorisations
};

struct SaddleStep {
  Eigen::VectorXd u, p;  ///< increments, global axes
  int iterations = 0;    ///< of the conjugate gradients on the pressure, or of GMRES
};

class SaddleSolver {
 public:
  explicit SaddleSolver(const std::shared_ptr<const NodePattern>& pattern,
                        LinearSolver kind = LinearSolver::direct);

  /// Imposes the constraints exactly (rotated axes, scaled identity: the pattern never changes) and
  /// factorises. Without positive definiteness a minimal multiple of SaddleMatrix::diagonal is
  /// added: ×8 from the last one that was needed / 8. `may_shift` false: fails instead.
  /// With multigrid the levels are built instead; only an indefinite direction that a coarse space
  /// sees is noticed.
  Factorisation factorise(const SaddleMatrix& matrix, const Constraints& constraints,
                          bool may_shift = true);

  /// The increments; `tolerance` is the relative residual of the volume equation (multigrid: of
  /// both equations, a tenth of it). `matrix` and the
  /// constraints are those of the last factorise, except that increments may be given anew.
  SaddleStep solve(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                   const Eigen::VectorXd& theta, double tolerance = 1e-6) const;

  /// (K + κBᵀM⁻¹B)⁻¹ v on the free part, held components zero. With multigrid one cycle: a
  /// symmetric positive definite approximation.
  Eigen::VectorXd back_solve(const Eigen::VectorXd& v) const;

  const Constraints& constraints() const { return constraints_; }
  LinearSolver kind() const { return kind_; }
  /// Values kept and GFlop of one factorisation; with multigrid values of all levels, and zero.
  double factor_entries() const;
  double factor_gflop() const;
  /// Numerical factorisations (multigrid: constructions of the levels) so far.
  int factorisations() const { return factorisations_; }

 private:
  void impose(const SaddleMatrix& matrix);
  SaddleStep solve_by_factor(const SaddleMatrix& matrix, const Eigen::VectorXd& right,
                             const Eigen::VectorXd& imposed, const Eigen::VectorXd& theta,
                             double tolerance) const;
  SaddleStep solve_by_cycles(const SaddleMatrix& matrix, const Eigen::VectorXd& right,
                             const Eigen::VectorXd& imposed, const Eigen::VectorXd& theta,
                             double tolerance) const;

  LinearSolver kind_;
  std::unique_ptr<Cholesky> cholesky_;
  Multigrid multigrid_;
  NodeMatrix work_;
  Constraints constraints_;
  double last_shift_ = 0;
  int factorisations_ = 0;
};

}  // namespace breast
