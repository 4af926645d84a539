// SPDX-License-Identifier: GPL-3.0-or-later
// Unusual breasts and unusual grids: the fit stays close, unfolded and star-shaped.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fit/fit_breast.hpp"
#include "fit/sheet_fit.hpp"
#include "fixtures/label_breast.hpp"

using namespace breast;
using breast::test::LabelBreast;

namespace {

void expect_good(const LabelBreast& shape, double mean_bound, Side side = Side::left) {
  LabelVolume labels = shape.labels();
  labels.side = side;
  FitReport report;
  Timer timer;
  const BreastGeometry g = fit_breast(labels, {}, report, timer);
  EXPECT_FALSE(check_folds(g.skin).folded());
  EXPECT_TRUE(star_shaped(g.rim_skin, g.centre));
  EXPECT_TRUE(star_shaped(g.rim_wall, centroid(g.rim_wall)));
  std::vector<double> truth;
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) {
      const Vec2 st(i / 40.0, j / 40.0);
      if (inside_star(g.rim_skin, g.centre, st))
        truth.push_back(shape.distance(g.skin.position(st)));
    }
  const Distances summary = summarise(truth);
  EXPECT_GT(truth.size(), 200u);
  EXPECT_LT(summary.mean_mm, mean_bound);
  EXPECT_LT((g.nipple - shape.nipple()).norm(), 3);
  EXPECT_GT(report.body_ml, 0.7 * report.label_ml);
  EXPECT_LT(report.body_ml, 1.4 * report.label_ml);
}

}  // namespace

TEST(FitShapes, SmallBreast) {
  LabelBreast shape;
  shape.radius = 34, shape.neck = 32, shape.depth = 8, shape.drop = 3;
  expect_good(shape, 0.3);
}

TEST(FitShapes, LongHangingBreastWithANarrowNeck) {
  LabelBreast shape;
  shape.radius = 44, shape.neck = 30, shape.depth = 105, shape.drop = 15;
  expect_good(shape, 0.35);
}

TEST(FitShapes, ThickSlices) {
  LabelBreast shape;
  shape.spacing = Vec3(1.4, 1.4, 5.5);
  expect_good(shape, 0.35);
}

TEST(FitShapes, SagittalSlicesRunningBackwards) {
  LabelBreast shape;
  shape.spacing = Vec3(1.6, 1.6, 3);
  shape.direction << 0, 0, -1, 1, 0, 0, 0, -1, 0;  // i: +y, j: -z, k: -x
  expect_good(shape, 0.3, Side::right);
}

TEST(FitShapes, TiltedGrid) {
  LabelBreast shape;
  shape.direction = Eigen::AngleAxisd(0.12, Vec3(0.3, 0.2, 0.9).normalized()).toRotationMatrix();
  expect_good(shape, 0.3);
}
