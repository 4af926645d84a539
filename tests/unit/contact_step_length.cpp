// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/step_length.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace breast;

namespace {

PathPoint at(double thickness, double paddle_N = 0) {
  PathPoint point;
  point.thickness = thickness;
  point.paddle_N = paddle_N;
  return point;
}

}  // namespace

TEST(NextPosition, IsOneStepCloser) {
  EXPECT_EQ(next_thickness(7, at(100), nullptr, {}), 93);
  EXPECT_EQ(next_thickness(7, at(100), nullptr, {50, {}, {}}), 93);
}

// A very short step just before the end is avoided.
TEST(NextPosition, IsTheEndIfThatIsNear) {
  EXPECT_EQ(next_thickness(7, at(58), nullptr, {50, {}, {}}), 50);
  EXPECT_EQ(next_thickness(7, at(59), nullptr, {50, {}, {}}), 52);
  EXPECT_EQ(next_thickness(7, at(45), nullptr, {50, {}, {}}), 50);
}

TEST(NextPosition, IsTheNextCornerOfTheLoadInsteadOfOneBeyondIt) {
  const PathStops stops{50, {}, {96, 90, 52}};
  EXPECT_EQ(next_thickness(7, at(100), nullptr, stops), 96);
  EXPECT_EQ(next_thickness(7, at(96), nullptr, stops), 90);
  EXPECT_EQ(next_thickness(7, at(90), nullptr, stops), 83);
  EXPECT_EQ(next_thickness(7, at(59.5), nullptr, stops), 52);
  EXPECT_EQ(next_thickness(7, at(52), nullptr, stops), 50);
}

TEST(NextPosition, DoesNotPassAForceByMuch) {
  const PathStops stops{{}, {{TargetKind::force, 100, {}}}, {}};
  const PathPoint before = at(107, 40);
  const double next = next_thickness(7, at(100, 80), &before, stops);
  // The force doubled in 7 mm: 115 N are reached 7 log2(115/80) mm further on.
  EXPECT_NEAR(next, 100 - 7 * std::log2(115.0 / 80), 1e-12);
}

TEST(StepLength, GrowsAfterAnEasyPositionAndShrinksAfterAHardOne) {
  StepLength step(4, 0.05);
  step.limit(7);
  step.adapt(5);
  EXPECT_DOUBLE_EQ(step.mm(), 5.6);
  step.adapt(5);
  EXPECT_DOUBLE_EQ(step.mm(), 7);  // the longest
  step.adapt(10);
  EXPECT_DOUBLE_EQ(step.mm(), 7);
  step.adapt(13);
  EXPECT_DOUBLE_EQ(step.mm(), 4.9);
}

TEST(StepLength, IsUsedTwiceAfterItWasHalved) {
  StepLength step(4, 0.05);
  step.limit(7);
  EXPECT_TRUE(step.halve(4));
  step.adapt(5);
  EXPECT_DOUBLE_EQ(step.mm(), 2);
  step.adapt(5);
  EXPECT_DOUBLE_EQ(step.mm(), 2.8);
}

TEST(StepLength, EndsBelowTheShortestAndCanBeginAnew) {
  StepLength step(1, 0.3);
  step.limit(7);
  EXPECT_TRUE(step.halve(1));
  EXPECT_FALSE(step.distrusts_extrapolation());
  EXPECT_FALSE(step.halve(0.5));
  EXPECT_TRUE(step.distrusts_extrapolation());
  step.restart();
  EXPECT_EQ(step.mm(), 7);
  EXPECT_FALSE(step.distrusts_extrapolation());
}
