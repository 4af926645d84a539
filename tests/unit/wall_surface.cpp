// SPDX-License-Identifier: GPL-3.0-or-later
// The surface a breast slides on: its derivatives, its ends, and its fit to a thorax.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/fit_breast.hpp"
#include "fit/wall/ellipse_fit.hpp"
#include "fixtures/block.hpp"
#include "fixtures/label_breast.hpp"

namespace breast {
namespace {

ThoraxSurface bumpy() {
  ThoraxSurface s;
  s.origin = Vec3(5, 80, -10);
  s.slope = 0.15;
  s.angle_low = -1.2, s.angle_high = 2.2;
  s.height_low = -150, s.height_high = 170;
  s.angles = 17, s.heights = 14;
  for (int i = 0; i < (s.angles + 3) * (s.heights + 3); ++i) {
    s.coefficients.push_back(110 + 4 * fixtures::noise(i));
  }
  return s;
}

TEST(WallSurface, DerivativesMatchFiniteDifferences) {
  const ThoraxSurface surface = bumpy();
  const double h = 1e-4;
  for (int i = 0; i < 200; ++i) {
    const Vec3 x =
        surface.point(0.5 + 1.6 * fixtures::noise(3 * i), 150 * fixtures::noise(3 * i + 1)) +
        Vec3::Constant(10 * fixtures::noise(3 * i + 2));
    const std::optional<Level> here = surface.at(x);
    if (!here) continue;
    for (int a = 0; a < 3; ++a) {
      const auto up = surface.at(x + h * Vec3::Unit(a)), down = surface.at(x - h * Vec3::Unit(a));
      if (!up || !down) continue;
      EXPECT_NEAR((up->value - down->value) / (2 * h), here->gradient[a], 1e-7);
      EXPECT_LT(((up->gradient - down->gradient) / (2 * h) - here->hessian.col(a)).norm(), 1e-5);
    }
  }
}

// Second derivatives have no jump at the knots.
TEST(WallSurface, IsTwiceContinuouslyDifferentiable) {
  const ThoraxSurface surface = bumpy();
  const double step = (surface.angle_high - surface.angle_low) / surface.angles;
  for (int knot = 1; knot < surface.angles; ++knot) {
    const double angle = surface.angle_low + knot * step;
    const auto before = surface.at(surface.point(angle - 1e-9, 3)),
               after = surface.at(surface.point(angle + 1e-9, 3));
    ASSERT_TRUE(before && after);
    EXPECT_LT((before->hessian - after->hessian).norm(), 1e-6);
  }
}

TEST(WallSurface, PointsLieOnItAndItEnds) {
  const ThoraxSurface surface = bumpy();
  EXPECT_NEAR(surface.at(surface.point(0.7, 20))->value, 0, 1e-12);
  EXPECT_GT(surface.at(Vec3(5, -60, 0))->value, 0) << "in front of it";
  EXPECT_FALSE(surface.at(surface.point(0.7, 20) + Vec3(0, 0, 500)));
  EXPECT_FALSE(surface.at(surface.origin)) << "on the axis";
  EXPECT_FALSE(surface.at(Vec3(5, 300, 0))) << "behind its last angle";
}

TEST(EllipticCylinder, IsFoundFromAnArcWithOutliers) {
  const EllipticCylinder truth{4, 90, 0, 0.2, 150, 105};
  std::vector<Vec3> points;
  for (int i = 0; i < 900; ++i) {
    const double angle = -0.2 + 1.5 * (i % 30) / 29.0, z = -80 + 160 * (i / 30) / 29.0;
    const double r = truth.radius(angle) + fixtures::noise(i) + (i % 20 == 0 ? 60 : 0);
    points.emplace_back(truth.centre_x + r * std::sin(angle),
                        truth.centre_y + truth.slope * z - r * std::cos(angle), z);
  }
  const EllipticCylinder found =
      fit_elliptic_cylinder(points, std::vector<double>(points.size(), 1), {4, 5});
  for (double angle = -0.2; angle < 1.3; angle += 0.1) {
    for (const double z : {-60.0, 0.0, 60.0}) {
      const double r = found.radius(angle);
      const Vec3 p(found.centre_x + r * std::sin(angle),
                   found.centre_y + found.slope * (z - found.z0) - r * std::cos(angle), z);
      const double u = p.x() - truth.centre_x, v = truth.centre_y + truth.slope * z - p.y();
      EXPECT_NEAR(std::hypot(u, v), truth.radius(std::atan2(u, v)), 3);
    }
  }
}

// The wall of the labelled breast: the surface passes the sheet within the rim and the labels beside
// it, and goes on without an end near by.
TEST(WallSurface, FollowsSheetAndLabelsAndGoesOn) {
  const test::LabelBreast shape;
  FitOptions options;
  options.surface_step_mm = 5;
  FitReport report;
  Timer timer;
  const BreastGeometry geometry = fit_breast(shape.labels(), options, report, timer);
  ASSERT_TRUE(geometry.thorax);
  EXPECT_LT(report.thorax.sheet_max_mm, 0.5);
  EXPECT_GT(report.thorax.wall_points, 50u);
  EXPECT_LT(report.thorax.wall_mean_mm, 1.5);
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const Vec2& st : geometry.rim_wall) {
    const Vec3 p = geometry.wall.position(st);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
    const auto level = geometry.thorax->at(p);
    ASSERT_TRUE(level);
    EXPECT_LT(std::abs(level->value), 1);
  }
  for (const double z : {low.z() - 120, high.z() + 120}) {
    EXPECT_TRUE(geometry.thorax->at(Vec3(0.5 * (low.x() + high.x()), low.y(), z)));
  }
}

}  // namespace
}  // namespace breast
