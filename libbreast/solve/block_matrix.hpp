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
#pragma omp parallel for num_threads(threads()) schedule(static)
    for (int i = 0; i < rows; ++i) {
      Eigen::Matrix<double, R, 1> sum = Eigen::Matrix<double, R, 1>::Zero();
      for (long k = start[i]; k < start[i + 1]; ++k) {
        sum.noalias() += block[k] * x.template segment<C>(long(C) * column[k]);
      }
      out.template segment<R>(long(R) * i) = sum;
    }
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

/// Both triangles of a symmetric node matrix.
BlockMatrix<3, 3> full_matrix(const NodeMatrix& lower);

}  // namespace breast
