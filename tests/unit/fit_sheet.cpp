// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares, projection and closest points on Hermite sheets.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "core/error.hpp"
#include "fit/closest_point.hpp"
#include "fit/hermite_basis.hpp"
#include "fit/line_solve.hpp"
#include "fit/sheet_fit.hpp"

using namespace breast;

namespace {

HermiteSheet random_sheet(int nu, int nv, double roughness, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-roughness, roughness);
  std::vector<Vec3> dofs;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      dofs.push_back(Vec3(10.0 * i + any(random), any(random), 12.0 * j + any(random)));
      dofs.push_back(Vec3(10 + any(random), any(random), any(random)));
      dofs.push_back(Vec3(any(random), any(random), 12 + any(random)));
      dofs.push_back(Vec3(any(random), any(random), any(random)));
    }
  HermiteSheet sheet;
  sheet.nu = nu;
  sheet.nv = nv;
  sheet.nodes.resize(std::size_t(nu + 1) * (nv + 1));
  set_sheet_dofs(sheet, dofs);
  return sheet;
}

std::vector<Vec3> sheet_dofs(const HermiteSheet& sheet) {
  std::vector<Vec3> dofs;
  dofs.reserve(4 * sheet.nodes.size());
  for (const auto& n : sheet.nodes) {
    dofs.push_back(n.x);
    dofs.push_back(n.scale_1 * n.x_1);
    dofs.push_back(n.scale_2 * n.x_2);
    dofs.push_back(n.scale_1 * n.scale_2 * n.x_12);
  }
  return dofs;
}

SheetData sample(const HermiteSheet& sheet, int n) {
  SheetData data;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vec2 st(double(i) / n, double(j) / n);
      data.st.push_back(st);
      data.points.push_back(sheet.position(st));
      data.normals.push_back(sheet.evaluate(st).normal());
    }
  data.weights.assign(data.points.size(), 1);
  data.tangential.assign(data.points.size(), 0.1);
  data.fixed.assign(data.points.size(), 0);
  return data;
}

}  // namespace

TEST(HermiteSheet, ParametersThatAreNoNumbersGiveNoPlaceAndReadNoMemory) {
  const HermiteSheet sheet = random_sheet(3, 2, 0.5, 1);
  const double none = std::nan(""), far = 1e300;
  EXPECT_FALSE(sheet.position(Vec2(none, 0.5)).allFinite());
  EXPECT_FALSE(sheet.position(Vec2(0.5, none)).allFinite());
  EXPECT_EQ(sheet.position(Vec2(far, -far)), sheet.position(Vec2(1, 0)));
}

TEST(SheetBasis, DerivativesAgreeWithDifferences) {
  const HermiteSheet sheet = random_sheet(4, 3, 2, 1);
  const double h = 1e-5;
  for (const Vec2& st : {Vec2(0.13, 0.4), Vec2(0.61, 0.88), Vec2(0.92, 0.07)}) {
    const SheetPoint at = sheet.evaluate(st);
    const auto x = [&](double ds, double dt) { return sheet.position(st + Vec2(ds, dt)); };
    EXPECT_LT((at.x_s - (x(h, 0) - x(-h, 0)) / (2 * h)).norm(), 1e-6 * at.x_s.norm());
    EXPECT_LT((at.x_t - (x(0, h) - x(0, -h)) / (2 * h)).norm(), 1e-6 * at.x_t.norm());
    const SheetCurvature k = curvature(sheet, st);
    const auto d = [&](double ds, double dt) { return sheet.evaluate(st + Vec2(ds, dt)); };
    EXPECT_LT((k.x_ss - (d(h, 0).x_s - d(-h, 0).x_s) / (2 * h)).norm(), 1e-4);
    EXPECT_LT((k.x_st - (d(0, h).x_s - d(0, -h).x_s) / (2 * h)).norm(), 1e-4);
    EXPECT_LT((k.x_tt - (d(0, h).x_t - d(0, -h).x_t) / (2 * h)).norm(), 1e-4);
  }
}

TEST(SheetBasis, DegreesOfFreedomSurviveTheScaleFactors) {
  const HermiteSheet sheet = random_sheet(3, 5, 1, 2);
  HermiteSheet again = sheet;
  set_sheet_dofs(again, sheet_dofs(sheet));
  for (const Vec2& st : {Vec2(0.2, 0.3), Vec2(0.77, 0.51)})
    EXPECT_LT((sheet.position(st) - again.position(st)).norm(), 1e-12);
  EXPECT_NEAR(sheet.node(1, 2).x_1.norm(), 1, 0.5);
}

TEST(SheetFit, WithoutSmoothingASheetIsFoundAgain) {
  const HermiteSheet sheet = random_sheet(4, 4, 1, 3);
  const HermiteSheet fitted = solve_sheet(4, 4, sample(sheet, 40), 1e-14);
  for (int k = 0; k < 50; ++k) {
    const Vec2 st(0.5 + 0.49 * std::sin(k), 0.5 + 0.49 * std::cos(1.7 * k));
    EXPECT_LT((sheet.position(st) - fitted.position(st)).norm(), 1e-5) << st.transpose();
  }
}

TEST(SheetFit, SmoothingLeavesAPlaneAlone) {
  HermiteSheet plane = random_sheet(3, 3, 0, 4);
  const HermiteSheet fitted = solve_sheet(5, 6, sample(plane, 30), 1);
  EXPECT_LT((plane.position({0.37, 0.9}) - fitted.position({0.37, 0.9})).norm(), 1e-6);
}

TEST(SheetFit, TangentsAreContinuousAcrossPatches) {
  SheetData data = sample(random_sheet(6, 6, 3, 5), 50);
  const HermiteSheet fitted = solve_sheet(4, 5, data, 1e-8);
  const double e = 1e-9;
  for (int k = 1; k < 4; ++k)
    for (const double t : {0.05, 0.33, 0.71}) {
      const SheetPoint a = fitted.evaluate({k / 4.0 - e, t}), b = fitted.evaluate({k / 4.0 + e, t});
      EXPECT_LT((a.x - b.x).norm(), 1e-6);
      EXPECT_LT((a.x_s - b.x_s).norm(), 1e-4);
      EXPECT_LT((a.x_t - b.x_t).norm(), 1e-4);
    }
  for (int k = 1; k < 5; ++k) {
    const SheetPoint a = fitted.evaluate({0.4, k / 5.0 - e}),
                     b = fitted.evaluate({0.4, k / 5.0 + e});
    EXPECT_LT((a.x_t - b.x_t).norm(), 1e-4);
    EXPECT_LT((a.x_s - b.x_s).norm(), 1e-4);
  }
}

TEST(SheetFit, ProjectionRecoversShiftedParameters) {
  const HermiteSheet sheet = random_sheet(5, 5, 1, 6);
  SheetData data = sample(sheet, 30);
  for (std::size_t k = 0; k < data.st.size(); ++k)
    data.st[k] += Vec2(0.02 * std::sin(double(k)), 0.02 * std::cos(double(k)));
  EXPECT_LT(project(sheet, data), 1e-6);
}

TEST(SheetFit, NoDataIsRefused) {
  EXPECT_THROW(solve_sheet(3, 3, SheetData{}, 1e-6), Error);
}

TEST(SheetFit, AFoldIsSeen) {
  HermiteSheet sheet = random_sheet(4, 4, 0, 7);
  EXPECT_FALSE(check_folds(sheet).folded());
  sheet.node(2, 2).x -= Vec3(25, 0, 0);
  EXPECT_TRUE(check_folds(sheet).folded());
}

TEST(ClosestPoint, AgreesWithBruteForce) {
  const HermiteSheet sheet = random_sheet(5, 4, 3, 8);
  const SheetLocator locator(sheet);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> x(-15, 65), y(-30, 30), z(-15, 63);
  const int n = 300;
  std::vector<Vec3> dense;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) dense.push_back(sheet.position({double(i) / n, double(j) / n}));
  for (int k = 0; k < 100; ++k) {
    const Vec3 target(x(random), y(random), z(random));
    double brute = 1e30;
    for (const Vec3& p : dense) brute = std::min(brute, (p - target).norm());
    const SheetFoot foot = locator.closest(target);
    EXPECT_NEAR((sheet.position(foot.st) - target).norm(), foot.distance, 1e-9);
    EXPECT_LE(foot.distance, brute + 1e-9) << target.transpose();
    EXPECT_GT(foot.distance, brute - 0.25);
  }
}

TEST(ClosestPoint, FootIsPerpendicularInside) {
  const HermiteSheet sheet = random_sheet(5, 5, 1, 10);
  const Vec2 st(0.43, 0.58);
  const SheetPoint at = sheet.evaluate(st);
  const SheetFoot foot = closest_from(sheet, at.x + 4 * at.normal(), st + Vec2(0.05, -0.04));
  EXPECT_LT((foot.st - st).norm(), 1e-7);
  EXPECT_NEAR(foot.distance, 4, 1e-9);
}

TEST(LineSolve, SolvesWhatADenseFactorisationSolves) {
  constexpr int n = 5, m = 24;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto block = [&] {
    return Eigen::MatrixXd::NullaryExpr(m, m, [&] { return any(random); }).eval();
  };
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n * m, n * m);
  LineMatrix lines{std::vector<Eigen::MatrixXd>(n), std::vector<Eigen::MatrixXd>(n)};
  for (int l = 0; l < n; ++l) {
    const Eigen::MatrixXd own = block();
    lines.own[l] = own * own.transpose() + 40 * Eigen::MatrixXd::Identity(m, m);
    lines.before[l] = block();
    dense.block(l * m, l * m, m, m) = lines.own[l];
    if (l > 0) {
      dense.block(l * m, (l - 1) * m, m, m) = lines.before[l];
      dense.block((l - 1) * m, l * m, m, m) = lines.before[l].transpose();
    }
  }
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(n * m, -1, 1);
  Eigen::VectorXd x = dense * exact;
  LineMatrix negative = lines;
  ASSERT_TRUE(solve_lines(lines, x));
  EXPECT_LT((x - exact).norm(), 1e-12 * exact.norm());
  negative.own[3](7, 7) = -1;
  EXPECT_FALSE(solve_lines(negative, x));
}

TEST(SheetFit, SidesMayDifferEitherWay) {
  for (const auto& [nu, nv] : {std::pair{2, 6}, std::pair{6, 2}}) {
    const HermiteSheet exact = random_sheet(nu, nv, 0.5, 5);
    const HermiteSheet found = solve_sheet(nu, nv, sample(exact, 60), 1e-14);
    for (const Vec2& st : {Vec2(0.21, 0.4), Vec2(0.68, 0.93)})
      EXPECT_LT((found.position(st) - exact.position(st)).norm(), 1e-5);
  }
}
