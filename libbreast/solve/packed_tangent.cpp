// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/packed_tangent.hpp"

#include "core/parallel.hpp"

namespace breast {

namespace {

using Column = Eigen::Map<const Eigen::VectorXf>;

// y = A x, A by the columns of its lower triangle.
void multiply_packed(const float* a, const Eigen::VectorXf& x, Eigen::VectorXf& y) {
  const long n = x.size();
  y.setZero();
  for (long j = 0; j < n; ++j) {
    const long below = n - 1 - j;
    const Column column(a + 1, below);
    y[j] += a[0] * x[j] + column.dot(x.tail(below));
    y.tail(below) += x[j] * column;
    a += below + 1;
  }
}

void add_products(const PackedCells& part, const Eigen::VectorXd& v, Eigen::VectorXd& out) {
  const Cells& cells = *part.cells;
  const int n = part.size();
  Eigen::MatrixXf products(n, cells.count());
#pragma omp parallel num_threads(threads())
  {
    Eigen::VectorXf local(n), product(n);
#pragma omp for schedule(static)
    for (int c = 0; c < cells.count(); ++c) {
      for (int a = 0; a < n / 3; ++a) {
        local.segment<3>(3L * a) = v.segment<3>(3L * cells.cell(c)[a]).cast<float>();
      }
      multiply_packed(part.values.data() + part.length() * std::size_t(c), local, product);
      products.col(c) = product;
    }
  }
  for (int c = 0; c < cells.count(); ++c) {
    for (int a = 0; a < n / 3; ++a) {
      out.segment<3>(3L * cells.cell(c)[a]) += products.col(c).segment<3>(3L * a).cast<double>();
    }
  }
}

}  // namespace

void PackedCells::set(int cell, const double* matrix) {
  float* to = values.data() + length() * std::size_t(cell);
  const int n = size();
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) *to++ = float(matrix[std::size_t(j) * n + i]);
  }
}

Mat3 PackedCells::block(int cell, int a) const {
  const float* matrix = values.data() + length() * std::size_t(cell);
  Mat3 block;
  for (int k = 0; k < 3; ++k) {
    const int j = 3 * a + k;
    const float* column = matrix + std::size_t(j) * size() - std::size_t(j) * (j - 1) / 2;
    for (int i = k; i < 3; ++i) block(i, k) = block(k, i) = column[i - k];
  }
  return block;
}

PackedCells& PackedTangent::next(const Cells& cells) {
  PackedCells& part = parts_.emplace_back();
  part.cells = &cells;
  part.values.resize(part.length() * std::size_t(cells.count()));
  return part;
}

Eigen::VectorXd PackedTangent::apply(const Eigen::VectorXd& v) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  for (const PackedCells& part : parts_) add_products(part, v, out);
  return out;
}

std::vector<Mat3> PackedTangent::diagonal_blocks(int first, int last) const {
  std::vector<Mat3> blocks(std::size_t(last - first), Mat3::Zero());
  for (const PackedCells& part : parts_) {
    const Cells& cells = *part.cells;
    for (int c = 0; c < cells.count(); ++c) {
      for (int a = 0; a < cells.nodes_per_cell; ++a) {
        const int node = cells.cell(c)[a];
        if (node >= first && node < last) blocks[std::size_t(node - first)] += part.block(c, a);
      }
    }
  }
  return blocks;
}

}  // namespace breast
