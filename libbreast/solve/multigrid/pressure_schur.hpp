// SPDX-License-Identifier: GPL-3.0-or-later
// Approximate inverse of the pressure's Schur complement, used where no factor is available:
//
//     S = (1 − κc) B K_κ⁻¹ Bᵀ + cM,    S⁻¹ = κM⁻¹ + (1 − κc)(B K⁻¹ Bᵀ + cM)⁻¹    (exactly)
//
// with a sparse matrix for B K⁻¹ Bᵀ. The mass matrix over μ is one for elements that are inf-sup
// stable. For 8-node elements with one pressure it is not: a pressure like (−1)^(i+j) f(k), slowly
// modulated, makes next to no force, so B K⁻¹ Bᵀ is smaller than M/μ by the square of the mesh size
// and GMRES would take as many more iterations as there are elements along an edge. There
//
//     B K⁻¹ Bᵀ ~ 3/2 B D⁻¹ Bᵀ + Σ aₙ aₙᵀ / Σ μₑ aₙₑ     (sum over nodes n; aₙₑ the part of n in Mₑ)
//
// D the diagonal blocks of K_κ: the first term has S's own near-kernel, since such pressures move
// nodes against their neighbours, where K is like its diagonal (a weighted BFBt, Elman 1999; Rudi,
// Stadler and Ghattas 2017, without its second solve); the second is M/μ for smooth pressures and
// zero for those that alternate. Solved by a few conjugate gradients, so not a fixed linear map:
// for GMRES that keeps its preconditioned vectors (gmres.hpp).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solve/constraints.hpp"
#include "solve/multigrid/block_matrix.hpp"
#include "solve/saddle_matrix.hpp"

namespace breast {

/// The factor 3/2: for a wave that alternates from node to node, K is smaller than its diagonal blocks.
/// Measured: the numbers of GMRES iterations are equal for 1.5 to 3, and a fifth larger for 1.
inline constexpr double schur_gradient_weight = 1.5;
/// A relative residual of a tenth is sufficient within GMRES, and so are two steps for every element
/// along an edge: with one, GMRES takes 25 instead of 22 iterations on the block of 48³ and 26
/// instead of 19 on the dome of 32 000.
inline constexpr double schur_accuracy = 0.1, schur_steps_per_edge = 2;
inline constexpr int schur_least_steps = 20;
inline constexpr double schur_nothing_left = 1e-12;  ///< of 1 − κc

class PressureSchur {
 public:
  /// `imposed` is the matrix with its constraints imposed, in node axes. Returns false if the block
  /// of a node is not positive definite, and hence neither is the matrix.
  bool build(const SaddleMatrix& matrix, const NodeMatrix& imposed, const Constraints& constraints);
  /// Approximation of S⁻¹ q.
  Eigen::VectorXd solve(const Eigen::VectorXd& q) const;
  /// Number of stored values.
  double entries() const { return double(sparse_.block.size()); }

 private:
  Eigen::VectorXd solve_sparse(const Eigen::VectorXd& q) const;

  std::shared_ptr<const PressureSpace> space_;
  Eigen::VectorXd kappa_, shear_;
  double left_over_ = 0;        // 1 − κc
  BlockMatrix<1, 1> sparse_;    // what stands for B K⁻¹ Bᵀ + cM; empty where M/μ + cM does
  Eigen::VectorXd reciprocal_;  // of its diagonal
};

}  // namespace breast
