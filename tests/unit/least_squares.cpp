// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares by a trust region, with derivatives and with difference quotients.
#include "solve/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/error.hpp"

using namespace breast;

TEST(LeastSquares, FindsTheBottomOfACurvedValley) {
  const auto at = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]));
  };
  Eigen::VectorXd last;
  const LeastSquaresProblem problem{
      [&](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> { return last = x, at(x); },
      [&]() -> Eigen::MatrixXd {
        Eigen::Matrix2d j;
        j << -20 * last[0], 10, -1, 0;
        return j;
      }};
  LeastSquaresOptions options;
  options.tolerance = 1e-16, options.max_evaluations = 200;
  const LeastSquaresResult found = least_squares(problem, Eigen::Vector2d(-1.2, 1), options);
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.x - Eigen::Vector2d(1, 1)).norm(), 1e-7);
}

TEST(LeastSquares, StopsWhereTheModelHasNoAnswer) {
  Eigen::VectorXd last;
  const LeastSquaresProblem problem{
      [&](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
        if (x[0] > 1) return {};
        return last = x, Eigen::VectorXd(Eigen::VectorXd::Constant(1, x[0] - 3));
      },
      [] { return Eigen::MatrixXd::Ones(1, 1); }};
  LeastSquaresOptions options;
  options.max_evaluations = 100;
  const LeastSquaresResult found = least_squares(problem, Eigen::VectorXd::Zero(1), options);
  EXPECT_FALSE(found.converged);
  EXPECT_TRUE(found.at_limit);
  EXPECT_GT(found.x[0], 0.98);
  EXPECT_FALSE(found.refused.empty());
}

TEST(LeastSquares, WithoutDerivativesFindsTheMinimumAndItsCovariance) {
  // Two exponentials through three points and priors; the minimum is where the gradient vanishes.
  LeastSquaresProblem problem;
  problem.residuals = [](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    Eigen::VectorXd r(5);
    for (int k = 0; k < 3; ++k)
      r[k] = (std::exp(x[0]) + std::exp(x[1]) * k - (1.5 + 2.5 * k)) / 0.1;
    r[3] = x[0] / 2, r[4] = x[1] / 2;
    return r;
  };
  LeastSquaresOptions options;
  options.tolerance = 1e-10, options.difference = 1e-5, options.max_evaluations = 100;
  const LeastSquaresResult fit = least_squares(problem, Eigen::Vector2d(0, 0), options);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(std::exp(fit.x[0]), 1.5, 0.01);
  EXPECT_NEAR(std::exp(fit.x[1]), 2.5, 0.01);
  EXPECT_LT((fit.jacobian.transpose() * fit.residuals).norm(), 1e-5 * fit.jacobian.squaredNorm());
  EXPECT_NEAR(fit.covariance().inverse()(0, 0), 3 * 1.5 * 1.5 * 100, 10);
}

TEST(LeastSquares, DoesNotEndWhereOnlyItsUpdatedJacobianIsWorn) {
  // Rosenbrock's valley: Broyden's updates point across it, and shortened steps then lead nowhere.
  LeastSquaresProblem valley;
  valley.residuals = [](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    return Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
  };
  LeastSquaresOptions options;
  options.max_evaluations = 300, options.difference = 0.01;
  for (const Eigen::Vector2d& start : {Eigen::Vector2d(-0.5, 1), Eigen::Vector2d(-0.5, 4)}) {
    const LeastSquaresResult fit = least_squares(valley, start, options);
    EXPECT_TRUE(fit.converged);
    EXPECT_LT((fit.x - Eigen::Vector2d(1, 1)).norm(), 0.1) << fit.x.transpose();
    EXPECT_LT(fit.jacobians, fit.evaluations / 3) << "updates save most difference quotients";
  }
}

TEST(LeastSquares, AModelWithoutAnAnswerShortensTheStepAndIsNamedAtTheStart) {
  LeastSquaresProblem halved;
  halved.residuals = [](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    if (x[0] > 2.2) return {};
    return Eigen::VectorXd::Constant(1, std::exp(x[0]) - std::exp(2.0));
  };
  LeastSquaresOptions options;
  options.radius = 10, options.difference = 1e-4, options.tolerance = 1e-8;
  EXPECT_NEAR(least_squares(halved, Eigen::VectorXd::Zero(1), options).x[0], 2, 1e-3);
  LeastSquaresProblem none;
  none.residuals = [](const Eigen::VectorXd&) { return std::optional<Eigen::VectorXd>(); };
  EXPECT_THROW(least_squares(none, Eigen::VectorXd::Zero(1)), Error);
}
