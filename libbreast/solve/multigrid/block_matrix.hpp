// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse matrices of small dense blocks, by rows: the levels of a multigrid.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/parallel.hpp"
#include "solve/node_matrix.hpp"

namespace breast {

/// rows × columns blocks of R × C values; column[start[i]] … are the block columns of block row i.
template <int R, int C>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, R, C>;
  int rows = 0, columns = 0;
  std::vector<long> start{0};
  std::vector<int> column;
  std::vector<Block> block;

  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
    out.resize(long(R) * rows);
    // Below some tens of microseconds a product is over before a second thread wakes.
    const bool large = start.back() * R * C > 200000;
#pragma omp parallel for num_threads(threads()) schedule(static) if (large)
    for (int i = 0; i < rows; ++i) {
      Eigen::Matrix<double, R, 1> sum = Eigen::Matrix<double, R, 1>::Zero();
      for (long k = start[i]; k < start[i + 1]; ++k) {
        sum.noalias() += block[k] * x.template segment<C>(long(C) * column[k]);
      }
      out.template segment<R>(long(R) * i) = sum;
    }
  }
  /// Of a square matrix.
  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(long(R) * rows);
    for (int i = 0; i < rows; ++i) {
      for (long k = start[i]; k < start[i + 1]; ++k) {
        if (column[k] == i) out.template segment<R>(long(R) * i) = block[k].diagonal();
      }
    }
    return out;
  }
  /// out += Aᵀ x.
  void add_transposed(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
    for (int i = 0; i < rows; ++i) {
      for (long k = start[i]; k < start[i + 1]; ++k) {
        out.template segment<C>(long(C) * column[k]).noalias() +=
            block[k].transpose() * x.template segment<R>(long(R) * i);
      }
    }
  }
};

/// Rows of a matrix gathered block by block, in the order in which columns appear.
template <int R, int C>
class RowSum {
 public:
  explicit RowSum(int columns) : place_(std::size_t(columns), -1) {}
  Eigen::Matrix<double, R, C>& at(int column) {
    if (place_[column] < 0) {
      place_[column] = int(columns_.size());
      columns_.push_back(column);
      blocks_.push_back(Eigen::Matrix<double, R, C>::Zero());
    }
    return blocks_[place_[column]];
  }
  /// Appends the row to a matrix and forgets it.
  void flush(BlockMatrix<R, C>& to) {
    to.column.insert(to.column.end(), columns_.begin(), columns_.end());
    to.block.insert(to.block.end(), blocks_.begin(), blocks_.end());
    to.start.push_back(long(to.column.size()));
    for (const int column : columns_) place_[column] = -1;
    columns_.clear();
    blocks_.clear();
  }

 private:
  std::vector<int> place_, columns_;
  std::vector<Eigen::Matrix<double, R, C>> blocks_;
};

/// Both triangles of a symmetric node matrix.
BlockMatrix<3, 3> full_matrix(const NodeMatrix& lower);

}  // namespace breast
