// SPDX-License-Identifier: GPL-3.0-or-later
// The estimate of the time left, on a clock of the test's own.
#include "cli/time_left.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace breast {
namespace {

TEST(TimeLeft, EvenProgressIsExtrapolated) {
  TimeLeft left;
  EXPECT_FALSE(left.update("compress", 0, 100));
  for (int s = 1; s <= 39; ++s) {
    const auto estimate = left.update("compress", s / 40.0, 100 + s);
    if (s < 2) {
      EXPECT_FALSE(estimate) << "too early to say";
    } else {
      ASSERT_TRUE(estimate) << s;
      EXPECT_NEAR(*estimate, 40 - s, 1e-9) << s;
    }
  }
}

TEST(TimeLeft, ShortStagesSayNothing) {
  TimeLeft left;
  for (int i = 0; i <= 9; ++i) EXPECT_FALSE(left.update("fit", i / 9.0, i)) << i;
}

// A stage whose second half takes three times as long as its first: shortly into it the estimate follows.
TEST(TimeLeft, SlowerProgressIsFollowed) {
  TimeLeft left;
  for (int s = 0; s <= 10; ++s) left.update("compress", 0.05 * s, s);
  std::optional<double> estimate;
  for (int s = 11; s <= 25; ++s) estimate = left.update("compress", 0.5 + 0.5 * (s - 10) / 30.0, s);
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(*estimate, 15, 1.5);
}

TEST(TimeLeft, UnknownFractionsAndOtherStagesBeginAnew) {
  TimeLeft left;
  left.update("gravity", 0, 0);
  EXPECT_TRUE(left.update("gravity", 0.5, 20));
  EXPECT_FALSE(left.update("gravity", -1, 21));
  EXPECT_FALSE(left.update("gravity", std::numeric_limits<double>::quiet_NaN(), 22));
  EXPECT_FALSE(left.update("compress", 0.1, 30));
  const auto estimate = left.update("compress", 0.2, 40);
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(*estimate, 80, 1e-9) << "counted from the beginning of this stage";
  EXPECT_FALSE(left.update("image", 0, 41)) << "another stage";
}

TEST(TimeLeft, StagesOfOneWholeGoOn) {
  TimeLeft left;
  left.update("body", 0, 0);
  left.update("chest wall", 0.2, 4);
  const auto estimate = left.update("tissue", 0.8, 16);
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(*estimate, 4, 1e-9);
}

TEST(TimeLeft, StandingStillAndGoingBackAreNoEstimates) {
  TimeLeft left;
  left.update("forward", 0.5, 0);
  EXPECT_FALSE(left.update("forward", 0.5, 50));
  EXPECT_FALSE(left.update("forward", 0.2, 60));
  EXPECT_FALSE(left.update("forward", 1.5, 100)) << "more than all is all";
}

// Thousands of reports cost no memory and keep the estimate.
TEST(TimeLeft, ManyReports) {
  TimeLeft left;
  std::optional<double> estimate;
  for (int i = 0; i <= 90000; ++i) estimate = left.update("image", i / 100000.0, i * 1e-3);
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(*estimate, 10, 0.1);
}

TEST(TimeLeft, Words) {
  EXPECT_EQ(time_left_text(7.2), "about 8 s left");
  EXPECT_EQ(time_left_text(41), "about 45 s left");
  EXPECT_EQ(time_left_text(89.9), "about 90 s left");
  EXPECT_EQ(time_left_text(91), "about 2 min left");
  EXPECT_EQ(time_left_text(600), "about 10 min left");
}

}  // namespace
}  // namespace breast
