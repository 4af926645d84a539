// SPDX-License-Identifier: GPL-3.0-or-later
// The derivative of a problem with respect to its reference shape, stored per cell: it is applied
// but never factorised.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solve/saddle_matrix.hpp"

namespace breast {

/// One matrix per cell, 3n × 3n, column-major, one after another.
struct CellMatrices {
  const Cells* cells = nullptr;
  std::vector<double> values;

  int size() const { return 3 * cells->nodes_per_cell; }
  double* at(int cell) { return values.data() + std::size_t(cell) * size() * size(); }
  const double* at(int cell) const { return values.data() + std::size_t(cell) * size() * size(); }
};

/// ∂r/∂X, ∂θ/∂X and ∂θ/∂x of a problem. Every term fills a part of its own.
class ReferenceTangent {
 public:
  /// Starts a new pass, in which the next term gets the first part. The memory of an earlier pass
  /// is reused.
  void begin() { used_ = 0; }
  /// The part of the next term, over `cells`, which must outlive this object; its values are
  /// undefined.
  CellMatrices& next(const Cells& cells);

  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;            ///< (∂r/∂X) v
  Eigen::VectorXd apply_transpose(const Eigen::VectorXd& v) const;  ///< (∂r/∂X)ᵀ v

  ElementRows b_x;  ///< ∂θ/∂X
  ElementRows b;    ///< ∂θ/∂x

 private:
  Eigen::VectorXd sum(const Eigen::VectorXd& v, bool transposed) const;

  std::vector<CellMatrices> parts_;
  std::size_t used_ = 0;
};

}  // namespace breast
