// SPDX-License-Identifier: GPL-3.0-or-later
// The calibration finds a phantom again from the way its landmarks move.
#include <gtest/gtest.h>

#include "calibration/calibrate.hpp"
#include "calibration/softness.hpp"
#include "core/error.hpp"

using namespace breast;

TEST(Calibration, FindsTheSizeAndTumourThatMadeTheMotions) {
  const MaterialSet materials = load_materials("seed2008");
  const MeshParameters coarse{2, 1, 1, 1, 2, 2};
  BreastParameters hidden = resized(kind_breast("small"), 0.94);
  hidden.tumour_aside = 0.30;
  PhantomParameters parameters = phantom_preset("small", 1, hidden);
  parameters.mesh = coarse;
  const LandmarkMotion wanted = landmark_motion(parameters, Side::left, materials);
  EXPECT_GT(wanted.nipple_supine, wanted.nipple_free);

  const Calibration found =
      calibrate("small", 1, Side::left, wanted, materials, coarse, 10, no_progress());
  EXPECT_LE(found.evaluations, 10);
  EXPECT_NEAR(found.size, 0.94, 0.015);
  EXPECT_LT(found.misfit_mm, 0.1);
}

// The preset `paper` ended with its tumour_level on the lower bound, and nobody was told.
TEST(Calibration, AParameterOnItsBoundIsNamed) {
  Calibration found;
  found.size = 0.8938, found.tumour_aside = 0.6679, found.tumour_level = 0.6;
  EXPECT_TRUE(found.on_bounds().empty());
  found.tumour_level = 0.5;
  ASSERT_EQ(found.on_bounds().size(), 1u);
  EXPECT_NE(found.on_bounds()[0].find("tumour_level 0.5 lies on its bound (0.5 to 0.7)"),
            std::string::npos)
      << found.on_bounds()[0];
  found.size = 1.2999;  // within what the search resolves
  EXPECT_EQ(found.on_bounds().size(), 2u);
}

TEST(GaussNewton, FindsTheLeastSquaresAndTheirCovariance) {
  // Two exponentials through three points and priors; the minimum is where the gradient vanishes.
  const Residuals residuals = [](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    Eigen::VectorXd r(5);
    for (int k = 0; k < 3; ++k) r[k] = (std::exp(x[0]) + std::exp(x[1]) * k - (1.5 + 2.5 * k)) / 0.1;
    r[3] = x[0] / 2, r[4] = x[1] / 2;
    return r;
  };
  GaussNewtonOptions options;
  options.tolerance = 1e-6, options.difference = 1e-5, options.max_iterations = 40;
  const LeastSquares fit = gauss_newton(residuals, Eigen::Vector2d(0, 0), options);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(std::exp(fit.x[0]), 1.5, 0.01);
  EXPECT_NEAR(std::exp(fit.x[1]), 2.5, 0.01);
  EXPECT_LT((fit.jacobian.transpose() * fit.residuals).norm(), 1e-5 * fit.jacobian.squaredNorm());
  const Eigen::Matrix2d inverse = fit.covariance.inverse();
  EXPECT_NEAR(inverse(0, 0), 3 * 1.5 * 1.5 * 100, 10);
}

TEST(GaussNewton, DoesNotEndWhereOnlyItsJacobianIsWorn) {
  // Rosenbrock's valley: Broyden's updates point across it, and halved steps then lead nowhere.
  const Residuals valley = [](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    return Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
  };
  GaussNewtonOptions options;
  options.max_iterations = 60;
  for (const Eigen::Vector2d& start : {Eigen::Vector2d(-0.5, 1), Eigen::Vector2d(-0.5, 4)}) {
    const LeastSquares fit = gauss_newton(valley, start, options);
    EXPECT_TRUE(fit.converged);
    EXPECT_LT((fit.x - Eigen::Vector2d(1, 1)).norm(), 0.1) << fit.x.transpose();
  }
}

TEST(GaussNewton, AModelWithoutAnAnswerShortensTheStepAndIsNamedAtTheStart) {
  const Residuals halved = [](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    if (x[0] > 2.2) return {};
    return Eigen::VectorXd::Constant(1, std::exp(x[0]) - std::exp(2.0));
  };
  GaussNewtonOptions options;
  options.largest_step = 10, options.difference = 1e-4, options.tolerance = 1e-4;
  EXPECT_NEAR(gauss_newton(halved, Eigen::VectorXd::Zero(1), options).x[0], 2, 1e-3);
  const Residuals none = [](const Eigen::VectorXd&) { return std::optional<Eigen::VectorXd>(); };
  EXPECT_THROW(gauss_newton(none, Eigen::VectorXd::Zero(1)), Error);
}

TEST(Softness, ScalesLinearAndQuadraticTermsApart) {
  const MaterialSet base = load_materials("seed2008");
  Softness s;
  s.low_order = 0.5, s.quadratic = 0.1, s.skin = 2, s.wall = 0.03, s.cut = 0.04, s.sternum = 0.05;
  const MaterialSet set = softened(base, s);
  const std::vector<double>&was = base.law(Tissue::fat).constants, &is = set.law(Tissue::fat).constants;
  EXPECT_NEAR(is[0], 0.5 * was[0], 1e-12);
  EXPECT_NEAR(is[1], 0.5 * was[1], 1e-12);
  for (int k = 2; k < 5; ++k) EXPECT_NEAR(is[k], 0.1 * was[k], 1e-12);
  const MaterialSet stiff = softened(base, s, 5);
  const std::vector<double>&gland = stiff.law(Tissue::fibroglandular).constants,
                           &muscle = stiff.law(Tissue::muscle).constants;
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(muscle[k], 5 * gland[k], 1e-9);
  EXPECT_EQ(set.wall_support, 0.03);
  EXPECT_EQ(set.cut_support, 0.04);
  EXPECT_EQ(set.sternum_support, 0.05);
  EXPECT_THROW(softened(load_materials("victre"), s), Error);
  const Softness back = Softness::from_logarithms(s.logarithms());
  EXPECT_NEAR(back.quadratic, 0.1, 1e-15);
}
