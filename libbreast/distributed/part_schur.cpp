// SPDX-License-Identifier: GPL-3.0-or-later
// The sparse approximation of the pressure's Schur complement on several ranks: 3/2 B D⁻¹ Bᵀ + Σ
// aₙaₙᵀ / Σ μₑaₙₑ + cM of solve/multigrid/pressure_schur.hpp, written as GᵀG + cM with four rows of
// G per node.
#include <Eigen/Cholesky>
#include <cmath>

#include "distributed/part_matrices.hpp"
#include "solve/multigrid/pressure_schur.hpp"

namespace breast {

bool PartMatrices::inverse_roots(const SaddleMatrix& matrix, const Constraints& constraints,
                                 std::vector<Mat3>& roots) const {
  const int nodes = matrix.stiffness.pattern().nodes();
  Eigen::VectorXd blocks(9L * nodes);
  for (int node = 0; node < nodes; ++node) {
    Eigen::Map<Mat3>(blocks.data() + 9L * node) = matrix.stiffness.block(node, -1);
  }
  exchange_.complete(blocks);
  bool definite = true;
  for (int node = 0; node < nodes; ++node) {
    Mat3 block = Eigen::Map<const Mat3>(blocks.data() + 9L * node);
    const NodeConstraint* held = constraints.at(node);
    if (held != nullptr) block = (held->axes.transpose() * block * held->axes).eval();
    for (int i = 0; held != nullptr && i < 3; ++i) {
      if (!held->held[i]) continue;
      block.row(i).setZero();
      block.col(i).setZero();
      block(i, i) = 1;
    }
    const Eigen::LLT<Mat3> factor(block);
    definite = definite && factor.info() == Eigen::Success;
    Mat3 root = factor.matrixL().solve(Mat3::Identity());
    for (int i = 0; held != nullptr && i < 3; ++i) {
      if (held->held[i]) root.col(i).setZero();
    }
    roots.push_back(held != nullptr ? Mat3(root * held->axes.transpose()) : root);
  }
  return exchange_.ranks().all(definite);
}

// Rows: `rows_per_node` of every node; columns: elements.
OwnedMat PartMatrices::element_matrix(PetscInt rows_per_node) const {
  const Cells& cells = space_.cells;
  Eigen::VectorXd meet = Eigen::VectorXd::Zero(exchange_.part().mesh.nodes());
  for (const int node : cells.nodes) meet[node] += 1;
  const Eigen::VectorXd own = meet;
  exchange_.complete(meet);
  std::vector<PetscInt> here, there;
  for (int node = 0; node < numbering_.owned; ++node) {
    here.insert(here.end(), std::size_t(rows_per_node), PetscInt(own[node]));
    there.insert(there.end(), std::size_t(rows_per_node), PetscInt(meet[node] - own[node]));
  }
  OwnedMat out;
  ask(MatCreateAIJ(PETSC_COMM_WORLD, rows_per_node * numbering_.owned, numbering_.pressures,
                   PETSC_DETERMINE, PETSC_DETERMINE, 0, here.data(), 0, there.data(), out.fresh()));
  return out;
}

bool PartMatrices::fill_schur(const SaddleMatrix& matrix, const Constraints& constraints) {
  std::vector<Mat3> roots;
  if (!inverse_roots(matrix, constraints, roots)) return false;
  const ElementRows& b = matrix.divergence;
  const Cells& cells = *b.cells;
  const auto part = [&](int e) { return matrix.space->mass_at(e)(0, 0) / cells.nodes_per_cell; };
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(long(roots.size()));
  for (int e = 0; e < cells.count(); ++e) {
    for (int a = 0; a < cells.nodes_per_cell; ++a) {
      stiffness[cells.cell(e)[a]] += matrix.shear[e] * part(e);
    }
  }
  exchange_.complete(stiffness);
  const OwnedMat g = element_matrix(4);
  for (int e = 0; e < cells.count(); ++e) {
    const PetscInt column = numbering_.first_pressure + e;
    for (int a = 0; a < cells.nodes_per_cell; ++a) {
      const int node = cells.cell(e)[a];
      const Vec3 pushed = b.at(e).row(0).segment<3>(3L * a);
      Eigen::Vector4d values;
      values << std::sqrt(schur_gradient_weight) * (roots[node] * pushed),
          part(e) / std::sqrt(stiffness[node]);
      const PetscInt first = 4 * numbering_.node[node];
      const PetscInt rows[4] = {first, first + 1, first + 2, first + 3};
      ask(MatSetValues(g, 4, rows, 1, &column, values.data(), INSERT_VALUES));
    }
  }
  ask(MatAssemblyBegin(g, MAT_FINAL_ASSEMBLY));
  ask(MatAssemblyEnd(g, MAT_FINAL_ASSEMBLY));
  ask(MatTransposeMatMult(g, g, MAT_INITIAL_MATRIX, PETSC_DEFAULT, schur_.fresh()));
  OwnedVec compliance;
  ask(MatCreateVecs(schur_, compliance.fresh(), nullptr));
  double* values = nullptr;
  ask(VecGetArray(compliance, &values));
  for (int e = 0; e < cells.count(); ++e) {
    values[e] = matrix.space->compliance[e] * matrix.space->mass_at(e)(0, 0);
  }
  ask(VecRestoreArray(compliance, &values));
  ask(MatDiagonalSet(schur_, compliance, ADD_VALUES));
  return true;
}

}  // namespace breast
