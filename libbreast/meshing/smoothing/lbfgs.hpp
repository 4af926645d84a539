// SPDX-License-Identifier: GPL-3.0-or-later
// Deterministic limited-memory BFGS for the mesh smoother, which shortens its step where the energy
// is not finite.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace breast {

struct LbfgsOptions {
  int evaluations = 260;
  int memory = 12;
  double first_step = 0.1;  ///< largest component of the first step, in units of the unknowns
  /// Stop if ten iterations together reduce the energy by less than this fraction.
  double relative_decrease = 1e-6;
};
struct LbfgsResult {
  int evaluations = 0, iterations = 0;
  double first = 0, last = 0;
};

/// Minimises `energy(x, gradient)` from `x`, in place. All unknowns should have a similar scale.
LbfgsResult minimise_lbfgs(
    const std::function<double(const Eigen::VectorXd&, Eigen::VectorXd&)>& energy,
    Eigen::VectorXd& x, const LbfgsOptions& options);

}  // namespace breast
