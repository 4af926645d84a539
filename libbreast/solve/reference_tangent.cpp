// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/reference_tangent.hpp"

#include "core/parallel.hpp"

namespace breast {

namespace {

// out += Σ matrix_c v_c over cells: products in parallel, sums in cell order.
void add_products(const CellMatrices& part, const Eigen::VectorXd& v, bool transposed,
                  Eigen::VectorXd& out) {
  const Cells& cells = *part.cells;
  const int n = part.size();
  Eigen::MatrixXd products(n, cells.count());
#pragma omp parallel for num_threads(threads()) schedule(static)
  for (int c = 0; c < cells.count(); ++c) {
    const Eigen::VectorXd local = cells.gather(c, v);
    const Eigen::Map<const Eigen::MatrixXd> matrix(part.at(c), n, n);
    if (transposed) {
      products.col(c).noalias() = matrix.transpose() * local;
    } else {
      products.col(c).noalias() = matrix * local;
    }
  }
  for (int c = 0; c < cells.count(); ++c) {
    for (int a = 0; a < n / 3; ++a) {
      out.segment<3>(3L * cells.cell(c)[a]) += products.col(c).segment<3>(3L * a);
    }
  }
}

}  // namespace

CellMatrices& ReferenceTangent::next(const Cells& cells) {
  if (used_ == parts_.size()) parts_.emplace_back();
  CellMatrices& part = parts_[used_++];
  part.cells = &cells;
  part.values.resize(std::size_t(cells.count()) * part.size() * part.size());
  return part;
}

Eigen::VectorXd ReferenceTangent::sum(const Eigen::VectorXd& v, bool transposed) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  for (std::size_t i = 0; i < used_; ++i) add_products(parts_[i], v, transposed, out);
  return out;
}

Eigen::VectorXd ReferenceTangent::apply(const Eigen::VectorXd& v) const {
  return sum(v, false);
}

Eigen::VectorXd ReferenceTangent::apply_transpose(const Eigen::VectorXd& v) const {
  return sum(v, true);
}

}  // namespace breast
