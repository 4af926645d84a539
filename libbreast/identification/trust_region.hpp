// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear least squares by a trust region, for models with derivatives that take seconds and may
// have no solution.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace breast {

/// Residuals already divided by their standard deviations, with those of the prior, so that the
/// Jacobian has full rank.
struct LeastSquaresProblem {
  /// No value if the model has no solution, such as a body that does not exist.
  std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)> residuals;
  /// The Jacobian at the point of the last residuals; only requested if there was a solution.
  std::function<Eigen::MatrixXd()> jacobian;
};

struct TrustRegionOptions {
  Eigen::VectorXd unit;  ///< unit of length of each parameter in the region; empty for 1
  double radius = 0.7;   ///< initial radius, in these units
  double tolerance =
      2e-3;  ///< the fall of the sum of squares that the last model step still promises
  int max_evaluations = 25;
};

struct TrustRegionResult {
  Eigen::VectorXd x, residuals;
  Eigen::MatrixXd jacobian;              ///< at x
  std::vector<Eigen::VectorXd> refused;  ///< points at which the model had no solution
  int evaluations = 0, jacobians = 0;
  bool converged = false;
  /// True if the last step was shortened by a point without a solution, so that the best point lies
  /// at that limit.
  bool at_limit = false;
};

/// The Levenberg–Marquardt method with a trust region (Moré 1978). The step minimises the
/// linearised sum of squares within the region, which shrinks if the model disagrees with the
/// linearisation or has no solution. Throws Error (not converged) if there is no solution at the
/// start.
TrustRegionResult trust_region(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                               const TrustRegionOptions& options = {});

}  // namespace breast
