// SPDX-License-Identifier: GPL-3.0-or-later
// A symmetric tangent stored per cell in single precision, for large meshes that only need
// matrix-vector products, such as that of the error estimate.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/types.hpp"
#include "solve/cells.hpp"

namespace breast {

/// Lower triangles by columns, one cell after another.
struct PackedCells {
  const Cells* cells = nullptr;
  std::vector<float> values;

  int size() const { return 3 * cells->nodes_per_cell; }
  std::size_t length() const { return std::size_t(size()) * (size() + 1) / 2; }
  /// `matrix`: 3n × 3n, column-major; its lower triangle is read.
  void set(int cell, const double* matrix);
  /// The diagonal block of local node a.
  Mat3 block(int cell, int a) const;
};

class PackedTangent {
 public:
  /// Starts a new pass: the next term gets the first part.
  void begin(int elements) {
    parts_.clear();
    kappa = Eigen::VectorXd::Zero(elements);
  }
  /// The part of the next term, over `cells`, which must outlive this. Valid until the next call.
  PackedCells& next(const Cells& cells);

  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  /// 3×3 diagonal blocks of the nodes first, first + 1, ... last − 1.
  std::vector<Mat3> diagonal_blocks(int first, int last) const;

  Eigen::VectorXd kappa;  ///< κ per element that the matrices contain, Pa

 private:
  std::vector<PackedCells> parts_;
};

}  // namespace breast
