// SPDX-License-Identifier: GPL-3.0-or-later
// Preconditioned conjugate gradients for symmetric positive definite maps.
#pragma once

#include <Eigen/Core>

#include "solve/krylov/gmres.hpp"

namespace breast {

/// Convergence criterion for r = b − A x, measured by √(rᵀ P r) with the preconditioner P.
struct ConjugateGradientLimits {
  double relative = 0;  ///< bound relative to the initial value, which is P's norm of b
  double absolute = 0;  ///< absolute bound
  int iterations = 0;   ///< largest number of iterations
};

struct ConjugateGradientResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double start = 0, residual = 0;  ///< P's norm of b, and of r at the end
  bool converged = false;
};

/// Solves A x = b from zero. Stops early, not converged, along a direction without positive
/// curvature (Hestenes and Stiefel 1952).
ConjugateGradientResult conjugate_gradients(const LinearMap& a, const LinearMap& p,
                                            const Eigen::VectorXd& b,
                                            const ConjugateGradientLimits& limits);

}  // namespace breast
