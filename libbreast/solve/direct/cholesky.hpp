// SPDX-License-Identifier: GPL-3.0-or-later
// Multifrontal Cholesky of a symmetric node matrix: one analysis, many factorisations.
// Fronts are shared among threads by subtree, large ones by tiles; the result is the same
// for any number of threads.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solve/node_matrix.hpp"

namespace breast {

class Cholesky {
 public:
  /// Computes the ordering by nested dissection of the node graph (METIS) and the symbolic
  /// analysis.
  explicit Cholesky(const NodePattern& pattern);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// False when the matrix is not positive definite (or holds a non-finite value).
  bool factorise(const std::vector<double>& values);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;

  double factor_entries() const;  ///< values of L as stored, zeros of merged columns included
  double factor_gflop() const;    ///< work of one factorisation

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace breast
