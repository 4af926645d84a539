// SPDX-License-Identifier: GPL-3.0-or-later
// Curves in parameters: star shapes, insides, centroids; distances to triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "fit/rim.hpp"
#include "surface/rim_border.hpp"

using namespace breast;

namespace {

std::vector<Vec2> circle(const Vec2& centre, double radius, int n) {
  std::vector<Vec2> curve;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    curve.push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
  }
  return curve;
}

}  // namespace

TEST(RimCurve, CentroidOfAShiftedCircle) {
  EXPECT_LT((centroid(circle({0.3, 0.6}, 0.2, 96)) - Vec2(0.3, 0.6)).norm(), 1e-12);
}

TEST(RimCurve, StarShapeNeedsCounterClockwiseOrderAndAnInnerCentre) {
  auto curve = circle({0.5, 0.5}, 0.3, 64);
  EXPECT_TRUE(star_shaped(curve, {0.6, 0.5}));
  EXPECT_FALSE(star_shaped(curve, {0.9, 0.5}));
  std::reverse(curve.begin(), curve.end());
  EXPECT_FALSE(star_shaped(curve, {0.5, 0.5}));
  curve = circle({0.5, 0.5}, 0.3, 64);
  std::swap(curve[10], curve[11]);
  EXPECT_FALSE(star_shaped(curve, {0.5, 0.5}));
}

TEST(RimCurve, InsideAgreesWithTheCircle) {
  const auto curve = circle({0.5, 0.5}, 0.3, 256);
  for (int k = 0; k < 200; ++k) {
    const Vec2 st(0.5 + 0.45 * std::sin(3.1 * k), 0.5 + 0.45 * std::cos(1.3 * k));
    const double r = (st - Vec2(0.5, 0.5)).norm();
    if (std::abs(r - 0.3) > 1e-3) {
      EXPECT_EQ(inside_star(curve, {0.45, 0.52}, st), r < 0.3);
    }
  }
}

TEST(RimBorder, IsTheQuarterOfTheRimsBox) {
  std::vector<Vec3> rim;  // an ellipse of 80 x 60 mm about (70, -100, 20), from lateral to superior
  for (int i = 0; i < 96; ++i) {
    const double a = 2 * std::numbers::pi * i / 96;
    rim.push_back({70 + 40 * std::cos(a), -100 + 10 * std::sin(2 * a), 20 + 30 * std::sin(a)});
  }
  const std::vector<RimBorder> left = rim_borders(rim, Side::left),
                               right = rim_borders(rim, Side::right);
  const RimBorder expected[] = {RimBorder::lateral, RimBorder::superior, RimBorder::medial,
                                RimBorder::inferior};
  for (int quarter = 0; quarter < 4; ++quarter)
    EXPECT_EQ(left[std::size_t(24 * quarter)], expected[quarter]) << quarter;
  EXPECT_EQ(right[0], RimBorder::medial);
  EXPECT_EQ(right[48], RimBorder::lateral);
  for (int border = 0; border < n_rim_borders; ++border)
    EXPECT_NEAR(double(std::count(left.begin(), left.end(), RimBorder(border))), 24, 2);
}
