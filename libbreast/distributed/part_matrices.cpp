// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/part_matrices.hpp"

#include <algorithm>
#include <cmath>

#include "solve/multigrid/settings.hpp"

namespace breast {

namespace {

// A block of the stiffness at a node, its rows or its columns in the axes of the node and zero along
// constrained components.
void constrain(const NodeConstraint* held, Mat3& block, bool rows, bool columns) {
  if (held == nullptr) return;
  if (rows) block = (held->axes.transpose() * block).eval();
  if (columns) block = (block * held->axes).eval();
  for (int i = 0; i < 3; ++i) {
    if (!held->held[i]) continue;
    if (rows) block.row(i).setZero();
    if (columns) block.col(i).setZero();
  }
}

void finish(Mat a) {
  ask(MatAssemblyBegin(a, MAT_FINAL_ASSEMBLY));
  ask(MatAssemblyEnd(a, MAT_FINAL_ASSEMBLY));
}

}  // namespace

Numbering::Numbering(const Exchange& exchange, int pressures_per_element)
    : owned(exchange.part().owned) {
  const Ranks& ranks = exchange.ranks();
  const MeshPart& part = exchange.part();
  const long first = ranks.before(part.owned);
  all_nodes = PetscInt(ranks.sum(long(part.owned)));
  Eigen::VectorXd places(part.mesh.nodes());
  for (int i = 0; i < part.mesh.nodes(); ++i) places[i] = double(first + i);
  exchange.from_owner(places);
  for (const double place : places) node.push_back(PetscInt(std::lround(place)));
  pressures = PetscInt(pressures_per_element) * part.mesh.elements();
  first_pressure = PetscInt(ranks.before(pressures));
}

PartMatrices::PartMatrices(const Exchange& exchange, const Discretisation& space)
    : exchange_(exchange), space_(space), numbering_(exchange, space.pressures->rows) {
  make_stiffness();
}

// For rows shared with other ranks, at least as much space as all these ranks fill together.
void PartMatrices::make_stiffness() {
  const NodePattern& pattern = *space_.pattern;
  const int nodes = pattern.nodes(), owned = int(numbering_.owned);
  // Number of own columns and of columns of other ranks.
  Eigen::VectorXd room = Eigen::VectorXd::Zero(2L * nodes);
  const auto couple = [&](int row, int column) {
    if (row >= owned || column < owned) room[2L * row] += 1;
    if (row >= owned || column >= owned) room[2L * row + 1] += 1;
  };
  for (int column = 0; column < nodes; ++column) {
    couple(column, column);
    for (int k = 0; k < pattern.rows_count(column); ++k) {
      couple(pattern.rows_begin(column)[k], column);
      couple(column, pattern.rows_begin(column)[k]);
    }
  }
  exchange_.complete(room);
  std::vector<PetscInt> here, there;
  for (int node = 0; node < owned; ++node) {
    here.push_back(std::min(PetscInt(room[2L * node]), numbering_.owned));
    there.push_back(
        std::min(PetscInt(room[2L * node + 1]), numbering_.all_nodes - numbering_.owned));
  }
  ask(MatCreate(PETSC_COMM_WORLD, stiffness_.fresh()));
  ask(MatSetSizes(stiffness_, 3 * numbering_.owned, 3 * numbering_.owned, PETSC_DETERMINE,
                  PETSC_DETERMINE));
  ask(MatSetType(stiffness_, MATAIJ));
  ask(MatSetBlockSize(stiffness_, 3));
  ask(MatXAIJSetPreallocation(stiffness_, 3, here.data(), there.data(), nullptr, nullptr));
  ask(MatSetOption(stiffness_, MAT_SYMMETRIC, PETSC_TRUE));
}

// Every rank adds its part of a block, rotated into the axes of its nodes; the owner of a
// constrained component adds the one entry that remains for it.
void PartMatrices::fill_stiffness(const SaddleMatrix& matrix, const Constraints& constraints,
                                  double held) {
  const NodePattern& pattern = matrix.stiffness.pattern();
  ask(MatZeroEntries(stiffness_));
  std::vector<PetscInt> rows;
  std::vector<double> down, across;
  for (int column = 0; column < pattern.nodes(); ++column) {
    const int below = pattern.rows_count(column);
    rows.assign(1, numbering_.node[column]);
    down.resize(9UL * (below + 1));
    across.resize(9UL * below);
    for (int slot = -1; slot < below; ++slot) {
      const int row = slot < 0 ? column : pattern.rows_begin(column)[slot];
      if (slot >= 0) rows.push_back(numbering_.node[row]);
      Mat3 block = matrix.stiffness.block(column, slot);
      constrain(constraints.at(row), block, true, false);
      constrain(constraints.at(column), block, false, true);
      for (int i = 0; i < 3; ++i) {
        if (slot < 0 && constraints.held(row, i)) block(i, i) = row < numbering_.owned ? held : 0;
        for (int k = 0; k < 3; ++k) {
          down[3UL * (3 * (slot + 1) + i) + k] = block(i, k);
          if (slot >= 0) across[3UL * below * k + 3UL * slot + i] = block(i, k);
        }
      }
    }
    const PetscInt own = rows[0], count = PetscInt(rows.size());
    ask(MatSetValuesBlocked(stiffness_, count, rows.data(), 1, &own, down.data(), ADD_VALUES));
    ask(MatSetValuesBlocked(stiffness_, 1, &own, count - 1, rows.data() + 1, across.data(),
                            ADD_VALUES));
  }
  finish(stiffness_);
}

void PartMatrices::fill_rigid_motions(const Eigen::VectorXd& positions,
                                      const Constraints& constraints) {
  const Ranks& ranks = exchange_.ranks();
  const int owned = int(numbering_.owned);
  Vec3 middle = Vec3::Zero();
  for (int i = 0; i < owned; ++i) middle += positions.segment<3>(3L * i);
  for (int c = 0; c < 3; ++c) middle[c] = ranks.sum(middle[c]) / numbering_.all_nodes;
  double size = 0;
  for (int i = 0; i < owned; ++i) {
    size = std::max(size, (positions.segment<3>(3L * i) - middle).norm());
  }
  size = ranks.most(size);
  std::vector<OwnedVec> motions(6);
  std::vector<Vec> plain;
  std::vector<double*> values(6);
  for (int m = 0; m < 6; ++m) {
    ask(MatCreateVecs(stiffness_, motions[m].fresh(), nullptr));
    ask(VecGetArray(motions[m], &values[m]));
    plain.push_back(motions[m]);
  }
  for (int i = 0; i < owned; ++i) {
    const Vec3 arm = (positions.segment<3>(3L * i) - middle) / size;
    const Eigen::Matrix<double, 3, 6> motion = rigid_motion(arm, constraints.at(i));
    for (int m = 0; m < 6; ++m) {
      for (int k = 0; k < 3; ++k) values[m][3 * i + k] = motion(k, m);
    }
  }
  for (int m = 0; m < 6; ++m) {
    ask(VecRestoreArray(motions[m], &values[m]));
    for (int k = 0; k < m; ++k) {
      double along = 0;
      ask(VecDot(motions[m], motions[k], &along));
      ask(VecAXPY(motions[m], -along, motions[k]));
    }
    ask(VecNormalize(motions[m], nullptr));
  }
  Owned<MatNullSpace, MatNullSpaceDestroy> space;
  ask(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, 6, plain.data(), space.fresh()));
  ask(MatSetNearNullSpace(stiffness_, space));
}

OwnedMat PartMatrices::divergence(const SaddleMatrix& matrix, const Constraints& constraints,
                                  double factor) {
  const ElementRows& b = matrix.divergence;
  const Cells& cells = *b.cells;
  const int n = cells.nodes_per_cell, rows = b.rows;
  std::vector<PetscInt> here, there;
  for (int e = 0; e < cells.count(); ++e) {
    const auto own = std::count_if(cells.cell(e), cells.cell(e) + n,
                                   [&](int node) { return node < numbering_.owned; });
    here.insert(here.end(), std::size_t(rows), PetscInt(3 * own));
    there.insert(there.end(), std::size_t(rows), PetscInt(3 * (n - own)));
  }
  OwnedMat out;
  ask(MatCreateAIJ(PETSC_COMM_WORLD, numbering_.pressures, 3 * numbering_.owned, PETSC_DETERMINE,
                   PETSC_DETERMINE, 0, here.data(), 0, there.data(), out.fresh()));
  std::vector<PetscInt> row(std::size_t(rows), 0), column(3UL * n, 0);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(rows, 3 * n);
  for (int e = 0; e < cells.count(); ++e) {
    values = factor * b.at(e);
    for (int a = 0; a < n; ++a) {
      const int node = cells.cell(e)[a];
      if (const NodeConstraint* held = constraints.at(node)) {
        values.middleCols<3>(3L * a) = (values.middleCols<3>(3L * a) * held->axes).eval();
        for (int k = 0; k < 3; ++k) {
          if (held->held[k]) values.col(3L * a + k).setZero();
        }
      }
      for (int k = 0; k < 3; ++k) column[3UL * a + k] = 3 * numbering_.node[node] + k;
    }
    for (int i = 0; i < rows; ++i) row[i] = numbering_.first_pressure + rows * e + i;
    ask(MatSetValues(out, rows, row.data(), 3 * n, column.data(), values.data(), INSERT_VALUES));
  }
  finish(out);
  return out;
}

OwnedMat PartMatrices::compressibility(const SaddleMatrix& matrix, double factor) {
  const PressureSpace& space = *matrix.space;
  const int rows = space.rows;
  OwnedMat out;
  ask(MatCreateAIJ(PETSC_COMM_WORLD, numbering_.pressures, numbering_.pressures, PETSC_DETERMINE,
                   PETSC_DETERMINE, rows, nullptr, 0, nullptr, out.fresh()));
  std::vector<PetscInt> row(std::size_t(rows), 0);
  for (int e = 0; e < space.elements(); ++e) {
    // M is symmetric, so that the order by rows or by columns does not matter.
    const Eigen::MatrixXd values = factor * space.compliance[e] * space.mass_at(e);
    for (int i = 0; i < rows; ++i) row[i] = numbering_.first_pressure + rows * e + i;
    ask(MatSetValues(out, rows, row.data(), rows, row.data(), values.data(), INSERT_VALUES));
  }
  finish(out);
  return out;
}

bool PartMatrices::fill(const SaddleMatrix& matrix, const Constraints& constraints, double weigh,
                        double left_over) {
  const double nodes = 3.0 * double(numbering_.all_nodes);
  const double held =
      exchange_.dot(matrix.diagonal, Eigen::VectorXd::Ones(matrix.diagonal.size())) / nodes;
  schur_.reset();
  if (matrix.space->rows == 1 && left_over > 0 && !fill_schur(matrix, constraints)) return false;
  whole_.reset();
  fill_stiffness(matrix, constraints, std::max(held, 1e-300));
  fill_rigid_motions(matrix.positions, constraints);
  const OwnedMat b = divergence(matrix, constraints, weigh);
  OwnedMat transposed;
  ask(MatTranspose(b, MAT_INITIAL_MATRIX, transposed.fresh()));
  ask(MatScale(transposed, -left_over / weigh));
  const OwnedMat c = compressibility(matrix, weigh);
  const Mat blocks[4] = {stiffness_, transposed, b, c};
  ask(MatCreateNest(PETSC_COMM_WORLD, 2, nullptr, 2, nullptr, blocks, whole_.fresh()));
  return true;
}

}  // namespace breast
