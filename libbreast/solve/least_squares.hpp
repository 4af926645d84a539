// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear least squares with few parameters, for models that take seconds or minutes to evaluate and may
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
  /// The Jacobian at the point of the last residuals; only requested if there was a solution. Empty for
  /// a model without derivatives: the Jacobian is then taken from difference quotients, updated by
  /// Broyden's formula from every further evaluation, and taken anew before the search may end.
  std::function<Eigen::MatrixXd()> jacobian = {};
};

struct LeastSquaresOptions {
  Eigen::VectorXd unit = {};  ///< unit of length of each parameter in the region; empty for 1
  double radius = 0.7;        ///< initial radius of the region, in these units
  /// The fall of the sum of squares that the last model step still promises.
  double tolerance = 2e-3;
  int max_evaluations = 25;
  double difference = 0.15;  ///< step of the difference quotients, in the units
};

struct LeastSquaresResult {
  Eigen::VectorXd x, residuals;
  Eigen::MatrixXd jacobian;              ///< at x
  std::vector<Eigen::VectorXd> refused;  ///< points at which the model had no solution
  int evaluations = 0, jacobians = 0;
  bool converged = false;
  /// True if the last step was shortened by a point without a solution, so that the best point lies
  /// at that limit.
  bool at_limit = false;

  /// Covariance of the parameters, (JᵀJ)⁻¹.
  Eigen::MatrixXd covariance() const;
};

/// The Levenberg–Marquardt method with a trust region (Moré 1978). The step minimises the
/// linearised sum of squares within the region, which shrinks if the model disagrees with the
/// linearisation or has no solution. Throws Error (not converged) if there is no solution at the
/// start, or on either side of a parameter whose difference quotient is needed.
LeastSquaresResult least_squares(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                                 const LeastSquaresOptions& options = {});

}  // namespace breast
