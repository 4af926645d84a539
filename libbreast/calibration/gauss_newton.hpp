// SPDX-License-Identifier: GPL-3.0-or-later
// Weighted nonlinear least squares with few parameters and expensive residuals (minutes per
// evaluation).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

namespace breast {

/// Residuals at a point, divided by their standard deviations; no value if the model has no
/// solution, such as a body without equilibrium.
using Residuals = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;

struct GaussNewtonOptions {
  double difference = 0.15;  ///< step of the difference quotients
  double largest_step = 0.7;  ///< of any parameter in one iteration
  double tolerance = 0.02;    ///< largest change of a parameter at the end
  int max_iterations = 20;
};

struct LeastSquares {
  Eigen::VectorXd x, residuals;
  Eigen::MatrixXd jacobian;    ///< at x
  Eigen::MatrixXd covariance;  ///< (JᵀJ)⁻¹
  int evaluations = 0;
  bool converged = false;
};

/// Gauss–Newton iterations with a Jacobian from difference quotients at the start, at the end and
/// where steps lead nowhere, and Broyden's updates in between. Steps are halved until the sum of
/// squares falls. The residuals must contain a prior for every parameter that the data may not
/// determine. Throws Error (not converged) if the model has no solution at the start.
LeastSquares gauss_newton(const Residuals& residuals, Eigen::VectorXd start,
                          const GaussNewtonOptions& options = {});

}  // namespace breast
