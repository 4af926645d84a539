// SPDX-License-Identifier: GPL-3.0-or-later
// The saddle-point system of solve/saddle.hpp as PETSc matrices, assembled from every rank's part.
// For the .cpp files of this folder only.
#pragma once

#include <vector>

#include "distributed/exchange.hpp"
#include "distributed/petsc.hpp"
#include "solve/discretisation.hpp"

namespace breast {

/// Positions of a part's nodes and pressures in vectors over all ranks.
struct Numbering {
  Numbering(const Exchange& exchange, int pressures_per_element);
  std::vector<PetscInt> node;  ///< position of every node of the part
  PetscInt owned = 0;          ///< number of nodes owned by this rank
  PetscInt all_nodes = 0;      ///< number of nodes of the body
  PetscInt first_pressure = 0, pressures = 0;
};

class PartMatrices {
 public:
  PartMatrices(const Exchange& exchange, const Discretisation& space);

  /// Fills all matrices. Returns false on all ranks if the block of K of any node is not positive
  /// definite.
  bool fill(const SaddleMatrix& matrix, const Constraints& constraints, double weigh,
            double left_over);

  const Numbering& numbering() const { return numbering_; }
  Mat stiffness() const { return stiffness_; }
  /// The matrix [K, −(1 − κc)Bᵀ; wB, wcM] in the axes of constrained nodes, zero along constrained
  /// components.
  Mat whole() const { return whole_; }
  /// The sparse approximation of B K⁻¹ Bᵀ + cM (solve/multigrid/pressure_schur.hpp); null if M/μ +
  /// cM is used instead.
  Mat sparse_schur() const { return schur_; }

 private:
  void make_stiffness();
  void fill_stiffness(const SaddleMatrix& matrix, const Constraints& constraints, double held);
  void fill_rigid_motions(const Eigen::VectorXd& positions, const Constraints& constraints);
  OwnedMat divergence(const SaddleMatrix& matrix, const Constraints& constraints, double factor);
  OwnedMat compressibility(const SaddleMatrix& matrix, double factor);
  bool fill_schur(const SaddleMatrix& matrix, const Constraints& constraints);
  /// For every node the 3×3 matrix L⁻¹, where LLᵀ is the complete diagonal block of K in node axes;
  /// zero along constrained components.
  bool inverse_roots(const SaddleMatrix& matrix, const Constraints& constraints,
                     std::vector<Mat3>& roots) const;
  OwnedMat element_matrix(PetscInt rows_per_node) const;

  const Exchange& exchange_;
  const Discretisation& space_;
  Numbering numbering_;
  OwnedMat stiffness_, whole_, schur_;
};

}  // namespace breast
