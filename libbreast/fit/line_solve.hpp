// SPDX-License-Identifier: GPL-3.0-or-later
// Solver for block-tridiagonal systems, in which each line of unknowns couples only to itself and
// to adjacent lines.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace breast {

/// A symmetric positive definite matrix of n lines of m unknowns each.
struct LineMatrix {
  std::vector<Eigen::MatrixXd> own;  ///< n of m×m, the lower triangle is read
  std::vector<Eigen::MatrixXd>
      before;  ///< n of m×m: rows of line l, columns of line l − 1 (0: unused)
};

/// Solves by Cholesky's method line by line, which overwrites `matrix`; `right` contains n·m
/// values. Returns false if the matrix is not positive definite. Only Eigen's own kernels are used:
/// a BLAS would choose other kernels, with other roundings, on another processor.
bool solve_lines(LineMatrix& matrix, Eigen::VectorXd& right);

}  // namespace breast
