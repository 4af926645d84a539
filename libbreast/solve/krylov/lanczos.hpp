// SPDX-License-Identifier: GPL-3.0-or-later
// Extreme eigenvalues of a symmetric map by Lanczos' method.
#pragma once

#include <Eigen/Core>

#include "solve/krylov/gmres.hpp"

namespace breast {

/// Estimated upper bound of the largest eigenvalue of a symmetric map: the largest Ritz value after
/// `steps` products from `start` (not zero), plus its residual. Not finite if the map is not.
/// Unlike the power method with as many products, it is not misled by a start that hardly contains
/// the eigenvector (Saad 2011, "Numerical methods for large eigenvalue problems", section 6.3).
double largest_eigenvalue(const LinearMap& a, const Eigen::VectorXd& start, int steps);

struct LowestEigenvalue {
  double value = 0;     ///< the lowest Ritz value, an upper bound of the eigenvalue
  double residual = 0;  ///< there is an eigenvalue within this distance of it
  int steps = 0;
  /// Whether the eigenvalue is positive, unless the start hardly contained a lower eigenvector.
  bool positive() const { return value > 2 * residual; }
};

/// The lowest eigenvalue of p a for symmetric maps, p positive definite: its sign is that of the
/// lowest eigenvalue of a. Iterates from `start` (not zero) until the sign is known, with at most
/// `most` products.
LowestEigenvalue lowest_eigenvalue(const LinearMap& a, const LinearMap& p,
                                   const Eigen::VectorXd& start, int most);

}  // namespace breast
