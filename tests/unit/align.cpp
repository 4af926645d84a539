// SPDX-License-Identifier: GPL-3.0-or-later
// Laying a simulated view over a mammogram: axes, a known similarity under noise, foreign tissue
// and cropping.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "matching/image_field.hpp"
#include "matching/similarity.hpp"

using namespace breast;

namespace {

MammogramHeader header_of(const Vec3& right, const Vec3& down) {
  MammogramHeader header;
  header.pixel_mm = 0.25;
  header.columns = 480;
  header.rows = 720;
  header.right = right;
  header.down = down;
  return header;
}

// Half an egg with a nipple, chest wall at u = 0: (u,v) in mm.
Vec2 egg(double angle) {
  const double r = 70 * (1 + 0.12 * std::sin(angle) + 6 * std::exp(-angle * angle / 0.005) / 70);
  return {1.15 * r * std::cos(angle), 90 + r * std::sin(angle)};
}

AlignmentData scene(const Similarity& map, double noise, bool foreign, unsigned seed = 1) {
  std::mt19937 stream(seed);
  std::normal_distribution<double> normal;
  AlignmentData data;
  for (double a = -1.5; a <= 1.5; a += 0.005) data.simulated.push_back(egg(a));
  double wave = 0;
  for (double a = -1.55; a <= 1.55; a += 0.004) {
    const Vec2 along = (egg(a + 1e-4) - egg(a - 1e-4)).normalized();
    const Vec2 normal_uv(along.y(), -along.x());
    wave = 0.99 * wave + std::sqrt(1 - 0.99 * 0.99) * normal(stream);  // over some 10 mm
    // An arm or a fold that the model does not have.
    const double bulge = foreign && a > 1.2 ? 15 * (a - 1.2) / 0.35 : 0;
    const Vec2 at = map.apply(egg(a) + (noise * wave + bulge) * normal_uv);
    data.real.push_back({at, (map.apply(normal_uv) - map.apply(Vec2::Zero())).normalized()});
  }
  return data;
}

const ViewPose& pose() {
  static const ViewPose left = view_pose(Side::left, 0);
  return left;
}

}  // namespace

TEST(ImageAxes, FollowThePatientOrientationOfEitherSideAndAnyHanging) {
  for (const Side side : {Side::left, Side::right}) {
    for (const double angle : {0.0, 45.0, 90.0}) {
      const ViewPose view = view_pose(side, angle);
      for (const double right : {-1.0, 1.0}) {
        for (const double down : {-1.0, 1.0}) {
          const ImageAxes axes(header_of(right * view.e_u, down * view.e_v), view, "x");
          EXPECT_TRUE(axes.mm(Vec2(10, 4)).isApprox(Vec2(right * 2.5, down * 1), 1e-12));
          EXPECT_TRUE(axes.pixel(axes.mm(Vec2(3, 7))).isApprox(Vec2(3, 7), 1e-12));
          EXPECT_EQ(axes.anterior_is_right(), right > 0);
          EXPECT_NEAR(axes.posterior_border(), right > 0 ? -0.125 : -119.875, 1e-12);
          EXPECT_TRUE(axes.contains(axes.mm(Vec2(240, 360)), 10));
          EXPECT_FALSE(axes.contains(axes.mm(Vec2(2, 360)), 1));
        }
      }
    }
  }
  EXPECT_THROW(ImageAxes(header_of(Vec3::Zero(), pose().e_v), pose(), "x"), Error);
  EXPECT_THROW(ImageAxes(header_of(pose().e_v, pose().e_u), pose(), "x"), Error);
}

TEST(Similarity, InvertsItself) {
  const Similarity map{1.03, -4, Vec2(7, -2)};
  EXPECT_TRUE(map.invert(map.apply(Vec2(31, 52))).isApprox(Vec2(31, 52), 1e-12));
}

TEST(Align, FindsAKnownSimilarity) {
  const ImageAxes axes(header_of(pose().e_u, pose().e_v), pose(), "x");
  const Similarity map{1.02, 3, Vec2(6, 2)};
  const Alignment found = align_outlines(scene(map, 0, false), axes, "x");
  EXPECT_NEAR(found.map.scale, map.scale, 2e-3);
  EXPECT_NEAR(found.map.rotation_deg, map.rotation_deg, 0.1);
  EXPECT_LT((found.map.apply(Vec2(40, 90)) - map.apply(Vec2(40, 90))).norm(), 0.1);
  EXPECT_LT(found.residual_mm, 0.1);
}

TEST(Align, NoiseAndForeignTissueStayWithinWhatItSaysOfItself) {
  const ImageAxes axes(header_of(pose().e_u, pose().e_v), pose(), "x");
  const Similarity map{0.97, -2, Vec2(3, 5)};
  constexpr unsigned seeds = 25;
  for (const bool foreign : {false, true}) {
    int inside = 0, counted = 0;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const Alignment found = align_outlines(scene(map, 1.5, foreign, seed), axes, "x");
      for (const Vec2& uv : {Vec2(10, 60), Vec2(40, 90), Vec2(70, 110)}) {
        const double error = (found.map.apply(uv) - map.apply(uv)).norm();
        EXPECT_LT(error, 8);
        inside += error < 2.45 * found.deviation_mm();  // two axes, 95 %
        ++counted;
      }
      EXPECT_GT(found.residual_mm, 0.3);
    }
    EXPECT_GE(inside, 0.85 * counted) << foreign;
  }
}

TEST(Align, AMarkedNippleDecidesWhereTheOutlineDoesNot) {
  const ImageAxes axes(header_of(pose().e_u, pose().e_v), pose(), "x");
  AlignmentData circle;  // without nipple every rotation fits
  for (double a = -1.4; a <= 1.4; a += 0.01) {
    const Vec2 out(std::cos(a), std::sin(a));
    circle.simulated.push_back(70 * out + Vec2(0, 90));
    circle.real.push_back({70 * out + Vec2(0, 90), out});
  }
  const double turned = 2 * 3.14159265 / 180;
  const Vec2 nipple(70, 90), mark = Vec2(0, 90) + 70 * Vec2(std::cos(turned), std::sin(turned));
  circle.nipple = {nipple, mark};
  const Alignment marked = align_outlines(circle, axes, "x");
  EXPECT_GT(marked.map.rotation_deg, 0.5);
  EXPECT_LT(marked.map.rotation_deg, 2);
  EXPECT_GT(marked.rotation_sd_deg, 0.5);  // and says how little is known
}

// The upper half reaches farther than the lower one, as towards the axilla.
TEST(Align, AnImageUpsideDownIsRefused) {
  AlignmentData data = scene({1.01, 2, Vec2(5, 8)}, 0, false);
  const auto lopsided = [](const Vec2& at) {
    return Vec2(at.x() + 0.25 * std::max(0.0, at.y() - 90), at.y());
  };
  const Similarity map{1.01, 2, Vec2(5, 8)};
  for (Vec2& at : data.simulated) at = lopsided(at);
  for (OutlinePoint& point : data.real) point.at = map.apply(lopsided(map.invert(point.at)));
  const ImageAxes axes(header_of(pose().e_u, pose().e_v), pose(), "x");
  const Alignment upright = align_outlines(data, axes, "x");
  EXPECT_LT(upright.residual_mm, 1);
  check_upright(data, axes, upright, "x");
  const double height = axes.mm(Vec2(0, 719)).y();
  for (OutlinePoint& point : data.real) {
    point.at.y() = height - point.at.y();
    point.normal.y() *= -1;
  }
  const Alignment turned = align_outlines(data, axes, "x");
  EXPECT_GT(turned.residual_mm, 2);
  EXPECT_THROW(check_upright(data, axes, turned, "x"), Error);
}

TEST(Align, ABreastElsewhereIsRefused) {
  const ImageAxes axes(header_of(pose().e_u, pose().e_v), pose(), "x");
  EXPECT_THROW(align_outlines(scene({1, 0, Vec2(-200, 300)}, 0, false), axes, "x"), Error);
  EXPECT_THROW(align_outlines({}, axes, "x"), Error);
}

// A large breast with a flat front, which ends 3 mm in front of the border: the border still shows air.
TEST(ImageField, ABreastThatNearlyReachesTheBorderHasAirInFront) {
  MammogramScan scan;
  scan.header = header_of(pose().e_u, pose().e_v);
  for (int row = 0; row < scan.header.rows; ++row) {
    const double up = std::pow(std::abs(2.0 * row / scan.header.rows - 1), 2.5);
    for (int column = 0; column < scan.header.columns; ++column) {
      const bool inside = std::pow(column / 468.0, 2.5) + up < 1;
      scan.grey.push_back(inside ? 0.4f + 0.5f * float(row) / float(scan.header.rows) : 0.0f);
    }
  }
  const auto air = seen_air(scan, image_field(scan), "x");
  ASSERT_TRUE(air.has_value());
  EXPECT_TRUE(air->at_right);
  EXPECT_FALSE(air->bright);
}
