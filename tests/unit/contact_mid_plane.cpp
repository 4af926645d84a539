// SPDX-License-Identifier: GPL-3.0-or-later
// The mid-plane follows the breast: towards the plate that presses more, without a plate that retreats.
#include "contact/path/mid_plane.hpp"

#include <gtest/gtest.h>

using namespace breast;

namespace {

PathPoint pressed(double paddle_N, double detector_N, double paddle_edge_N = 0,
                  double detector_edge_N = 0) {
  PathPoint point;
  point.paddle_N = paddle_N;
  point.detector_N = detector_N;
  point.paddle_edge_N = paddle_edge_N;
  point.detector_edge_N = detector_edge_N;
  return point;
}

}  // namespace

TEST(MidPlane, StaysWhereTheDetectorCarriesTheWeightAndNoMore) {
  EXPECT_EQ(mid_plane_move(pressed(100, 105), 4, 5), 0);
  EXPECT_EQ(mid_plane_move(pressed(0, 0), 4, 0), 0);
}

TEST(MidPlane, MovesTowardsThePlateThatPressesMore) {
  EXPECT_GT(mid_plane_move(pressed(100, 110), 4, 5), 0);
  EXPECT_LT(mid_plane_move(pressed(100, 100), 4, 5), 0);
  EXPECT_GT(mid_plane_move(pressed(100, 105, 0, 10), 4, 5), 0);
  EXPECT_LT(mid_plane_move(pressed(100, 105, 10, 0), 4, 5), 0);
}

TEST(MidPlane, NoPlateRetreats) {
  EXPECT_EQ(mid_plane_move(pressed(0, 500), 4, 5), 2);
  EXPECT_EQ(mid_plane_move(pressed(500, 0), 4, 5), -2);
  EXPECT_EQ(mid_plane_move(pressed(0, 500), -4, 5), 0);
}

/// Half as long a step moves it half as far: the way does not depend on the steps.
TEST(MidPlane, MovesInProportionToTheClosing) {
  const PathPoint point = pressed(100, 108);
  EXPECT_NEAR(mid_plane_move(point, 2, 5), 0.5 * mid_plane_move(point, 4, 5), 1e-12);
}

/// A fold of skin that touches first does not take the plates with it.
TEST(MidPlane, SmallForcesSayLittle) {
  EXPECT_NEAR(mid_plane_move(pressed(0, 0.1), 4, 0), 4 * 2 * 0.1 / 10, 1e-12);
}
