// SPDX-License-Identifier: GPL-3.0-or-later
// The lowest mode of a symmetric map and its eigenvalue, positive or not: the direction in which a
// body leaves an unstable equilibrium.
#pragma once

#include <Eigen/Core>

#include "solve/krylov/gmres.hpp"

namespace breast {

struct LowestMode {
  Eigen::VectorXd mode;  ///< vᵀ diag(weight) v = 1
  double value = 0;      ///< vᵀ a v; the lowest eigenvalue is not above it
  int steps = 0;
};

/// Solves a v = value · diag(weight) v by conjugate gradients of the Rayleigh quotient (Knyazev
/// 2001, LOBPCG with one vector) from `start` (not zero), until a step changes the value by less
/// than `tolerance` of itself or after `most` steps. `p` is symmetric and positive definite and
/// close to a⁻¹ of a shifted a; both a and `p` map the free part into itself; weights are positive.
LowestMode lowest_mode(const LinearMap& a, const LinearMap& p, const Eigen::VectorXd& weight,
                       const Eigen::VectorXd& start, double tolerance, int most);

}  // namespace breast
