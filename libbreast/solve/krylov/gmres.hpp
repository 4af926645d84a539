// SPDX-License-Identifier: GPL-3.0-or-later
// GMRES with right preconditioning, for the unsymmetric systems of the backward problem.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace breast {

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct GmresResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0;  ///< relative to the right-hand side
  bool converged = false;
};

/// Solves A x = b, x = P y, without restart, to ‖b − A x‖ ≤ tolerance ‖b‖ (Saad and Schultz 1986).
GmresResult gmres(const LinearMap& a, const LinearMap& p, const Eigen::VectorXd& b,
                  double tolerance, int max_iterations);

}  // namespace breast
