// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothed-aggregation multigrid for a symmetric node matrix, whose coarse spaces are the rigid
// motions of aggregates: one V-cycle is a symmetric positive definite approximation of the inverse.
// It is our own code, since the packaged libraries that provide it (hypre, PETSc) need MPI in every
// program.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solve/constraints.hpp"
#include "solve/node_matrix.hpp"

namespace breast {

class Multigrid {
 public:
  Multigrid();
  ~Multigrid();
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  /// Builds all levels for a matrix in node axes. `positions` (3 per node, mm) give the rigid
  /// motions, `constraints` the axes and the held components. False when a diagonal entry or the
  /// coarsest matrix is not positive: the matrix then is not positive definite. (The converse does
  /// not hold: an indefinite direction that no coarse space sees goes unnoticed.)
  bool build(const NodeMatrix& matrix, const Constraints& constraints,
             const Eigen::VectorXd& positions);
  /// One V-cycle from zero.
  Eigen::VectorXd cycle(const Eigen::VectorXd& right) const;

  /// The finest level's matrix times v, on all threads.
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const;

  int levels() const;
  /// Number of entries of all levels relative to those of the finest.
  double complexity() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace breast
