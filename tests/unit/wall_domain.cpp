// SPDX-License-Identifier: GPL-3.0-or-later
// Where the view ends in front of, at or behind the depth to which the chest wall is sought.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segment/grid/itk_filters.hpp"
#include "segment/wall/extent.hpp"

namespace breast {
namespace {

/// A left breast, 40 mm high, 50 mm beside the midline of a chest whose skin lies at 50 mm.
struct Chest {
  static constexpr double sternal_skin = 50, aside = 50;
  Mask body;
  TorsoFront torso;

  Chest() {
    Grid grid;
    grid.size = {140, 100, 30};
    grid.spacing = Vec3(1.5, 1.5, 3);
    body = Mask(grid);
    torso.midline = 20;
    torso.skin = HeightField(grid.size[0], grid.size[2], no_depth);
    torso.cleft.assign(std::size_t(grid.size[2]), sternal_skin);
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double across = (i - torso.midline) * grid.spacing[0] - aside,
                     along = (k - 15) * grid.spacing[2];
        const double skin = sternal_skin - 40 * std::exp(-(across * across + along * along) / 900);
        torso.skin.at(i, k) = skin;
        for (int j = 0; j < grid.size[1]; ++j) body.at(i, j, k) = j * grid.spacing[1] > skin;
      }
    }
  }

  /// Slice k has data up to a row.
  template <class Row>
  Mask seen_to(const Row& last) const {
    Mask seen(body.grid);
    for (int k = 0; k < body.grid.size[2]; ++k)
      for (int j = 0; j <= std::min(last(k), body.grid.size[1] - 1); ++j)
        for (int i = 0; i < body.grid.size[0]; ++i) seen.at(i, j, k) = 1;
    return seen;
  }
};

TEST(WallDomain, ViewOfAPitchedBodyEndsElsewhereInEachSlice) {
  const Chest chest;
  const Mask seen = chest.seen_to([](int k) { return k == 0 ? -1 : 35 + k; });
  const WallDomain domain = wall_domain(chest.body, chest.torso, true, seen);
  const double step = chest.body.grid.spacing[1];
  for (int k = 1; k < chest.body.grid.size[2]; ++k)
    EXPECT_DOUBLE_EQ(domain.deepest.at(30, k), (35 + k) * step);
  EXPECT_DOUBLE_EQ(domain.deepest.at(30, 0), Chest::sternal_skin + sought_behind);
}

TEST(WallDomain, BreastStandsOnTheEndOfTheViewWhereTheChestDoesNotCurveBack) {
  const Chest chest;
  const Grid& grid = chest.body.grid;
  constexpr int last = 40;  // 60 mm
  const Mask seen = chest.seen_to([](int) { return last; });
  const WallDomain domain = wall_domain(chest.body, chest.torso, true, seen);
  ChestWall wall;
  wall.depth = HeightField(grid.size[0], grid.size[2], last * grid.spacing[1] - 1);
  wall.confidence = HeightField(grid.size[0], grid.size[2], 1);
  const BreastExtent extent = find_extent(wall, domain, chest.torso, signed_distance(chest.body),
                                          Side::left, Posture::prone);
  const auto covered = [&](double aside) {
    const int i = chest.torso.midline + int(aside / grid.spacing[0]);
    return extent.columns[15 * std::size_t(grid.size[0]) + i] != 0;
  };
  EXPECT_TRUE(covered(Chest::aside));
  EXPECT_FALSE(covered(curving_back + 10));
  EXPECT_FALSE(covered(10));
}

}  // namespace
}  // namespace breast
