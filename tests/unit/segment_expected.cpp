// SPDX-License-Identifier: GPL-3.0-or-later
// The errors that labels are expected to have.
#include "segment/expected.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace breast {
namespace {

/// A block of breast, 20 x 20 columns of 1 x 1 mm, 10 mm thick, in front of a flat wall that is seen everywhere.
Work block() {
  Work work;
  Grid grid;
  grid.size = {24, 20, 24};
  work.scan = Volume<float>(grid);
  work.breast = work.body.mask = Mask(grid);
  work.wall.depth = HeightField(24, 24, 14);
  work.wall.confidence = HeightField(24, 24, 1);
  work.extent.columns.assign(24 * 24, 0);
  for (int k = 2; k < 22; ++k) {
    for (int i = 2; i < 22; ++i) {
      work.extent.columns[std::size_t(k) * 24 + i] = 1;
      for (int j = 4; j < 20; ++j) {
        work.body.mask.at(i, j, k) = 1;
        work.breast.at(i, j, k) = j < 14;
      }
    }
  }
  return work;
}

TEST(Expected, WallIsAsUncertainAsItsVoxelsItsRiseAndWhatWasNotSeen) {
  Work work = block();
  const double flat = 0.8 / std::sqrt(12.0);
  EXPECT_NEAR(expected_wall_mm(work), flat, 1e-12);
  for (int k = 0; k < 24; ++k)
    for (int i = 0; i < 24; ++i) work.wall.depth.at(i, k) = 10 + 0.5 * k;
  EXPECT_NEAR(expected_wall_mm(work), 0.8 * std::sqrt(1.25 / 12), 1e-12);
  work = block();
  for (double& sure : work.wall.confidence.depth) sure = 0.9;
  EXPECT_NEAR(expected_wall_mm(work), flat + 0.5, 1e-12);
}

TEST(Expected, BreastMissesItsSurfaceAndWhatTheViewCuts) {
  const Work work = block();
  // Volume 4000 mm3; faces of 400 mm2 in front and 800 at the sides, a quarter of a voxel each, and 400 mm2 of wall.
  const double missed = 0.25 * 1200 + 400 * 0.8 / std::sqrt(12.0);
  EXPECT_NEAR(expected_breast_dice(work, 0), 1 - missed / 8000, 1e-12);
  const double cap = 300.0 * 300.0 / (4 * std::numbers::pi * std::cbrt(6000 / std::numbers::pi));
  EXPECT_NEAR(expected_breast_dice(work, 3), 1 - (missed + cap) / 8000, 1e-12);
}

}  // namespace
}  // namespace breast
