// SPDX-License-Identifier: GPL-3.0-or-later
// Muscle on the chest wall that is brighter than that behind it.
#include "segment/wall/front_muscle.hpp"

#include <gtest/gtest.h>

#include "segment/wall/wall_uncertainty.hpp"
#include "segment/work.hpp"

namespace breast {
namespace {

// A flat wall at 90 mm under 70 mm of fat, over 150 mm from the midline to the left.
struct FlatWall {
  Volume<float> ratio, skin_distance;
  WallDomain domain;
  ChestWall wall;
  BreastExtent extent;
  static constexpr double depth = 90, skin = 20;

  FlatWall() {
    Grid grid;
    grid.size = {100, 80, 30};
    grid.spacing = Vec3(1.5, 1.5, 3);
    ratio = Volume<float>(grid, 1.0f);
    domain.first = 0;
    domain.last = grid.size[0] - 1;
    domain.nearest.assign(std::size_t(grid.size[2]), 0);
    domain.deepest = HeightField(grid.size[0], grid.size[2], 110);
    domain.skin = HeightField(grid.size[0], grid.size[2], skin);
    wall.depth = HeightField(grid.size[0], grid.size[2], depth);
    wall.confidence = HeightField(grid.size[0], grid.size[2], 1);
    wall.muscle_ratio = 0.3;
    extent.columns.assign(std::size_t(grid.size[0]) * grid.size[2], 0);
    for (int k = 5; k < 25; ++k) extent.columns[std::size_t(k) * grid.size[0] + 50] = 1;
    fill(0, 1000, depth, 1000, 0.3f);
    skin_distance = Volume<float>(grid);
    for (int k = 0; k < grid.size[2]; ++k)
      for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i)
          skin_distance.at(i, j, k) = float(skin - j * grid.spacing[1]);
  }
  double include(double sternal_skin = 0) {
    return include_front_muscle(wall, ratio, &skin_distance, domain, extent,
                                std::vector<double>(std::size_t(ratio.grid.size[2]), sternal_skin));
  }
  /// Between two places across (mm) and two depths.
  void fill(double from, double to, double front, double back, float value) {
    const Grid& grid = ratio.grid;
    for (int k = 0; k < grid.size[2]; ++k)
      for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i) {
          const double x = i * grid.spacing[0], y = j * grid.spacing[1];
          if (x >= from && x < to && y >= front && y < back) ratio.at(i, j, k) = value;
        }
  }
  double depth_at(double x, int slice = 15) const { return wall.depth.at(int(x / 1.5), slice); }
};

TEST(FrontMuscle, LayerDoesNotReachWhereTheBreastHangs) {
  FlatWall flat;
  flat.fill(90, 1000, 70, FlatWall::depth, 0.65f);
  EXPECT_GT(flat.include(FlatWall::depth - 10), 0);
  EXPECT_NEAR(flat.depth_at(120), FlatWall::depth - 10, 2);
}

TEST(FrontMuscle, LayerThatRunsToTheSideIsBehindTheWall) {
  FlatWall flat;
  flat.fill(90, 1000, 78, FlatWall::depth, 0.65f);
  const double moved = flat.include();
  EXPECT_NEAR(flat.depth_at(120), 78, 1.6);
  EXPECT_NEAR(flat.depth_at(145), 78, 1.6);
  EXPECT_NEAR(flat.depth_at(60), FlatWall::depth, 0.1);
  EXPECT_NEAR(moved, 60 * 12 * 60 / 1000., 6);
}

TEST(FrontMuscle, BelowTheBreastTheWallStays) {
  FlatWall flat;
  flat.fill(90, 1000, 78, FlatWall::depth, 0.65f);
  flat.include();
  EXPECT_NEAR(flat.depth_at(120, 6), 78, 1.6);
  EXPECT_NEAR(flat.depth_at(120, 3), FlatWall::depth, 0.1);
  EXPECT_NEAR(flat.depth_at(120, 26), FlatWall::depth, 0.1);
}

TEST(FrontMuscle, GlandOnTheWallStaysBeforeIt) {
  FlatWall flat;
  flat.fill(30, 80, 78, FlatWall::depth, 0.5f);
  EXPECT_EQ(flat.include(), 0);
  EXPECT_NEAR(flat.depth_at(50), FlatWall::depth, 0.1);
}

TEST(FrontMuscle, GlandClearOfTheWallStaysBeforeIt) {
  FlatWall flat;
  flat.fill(90, 1000, 50, 76, 0.5f);
  flat.include();
  EXPECT_NEAR(flat.depth_at(120), FlatWall::depth, 0.1);
}

TEST(FrontMuscle, TheLowerSkinOfTheBreastIsNoMuscle) {
  // Slice 5 runs along it, and is as dark as muscle mixed with fat all the way to the wall.
  FlatWall flat;
  const Grid& grid = flat.ratio.grid;
  for (int j = 0; j * grid.spacing[1] < FlatWall::depth; ++j) {
    for (int i = 0; i < grid.size[0]; ++i) {
      flat.ratio.at(i, j, 5) = 0.6f;
      for (int k = 0; k < 5; ++k) flat.skin_distance.at(i, j, k) = 1;
    }
  }
  EXPECT_EQ(flat.include(), 0);
}

TEST(FrontMuscle, TheOtherSideMirrorsIt) {
  FlatWall flat;
  flat.fill(0, 60, 78, FlatWall::depth, 0.65f);
  flat.domain.left = false;
  flat.include();
  EXPECT_NEAR(flat.depth_at(30), 78, 1.6);
  EXPECT_NEAR(flat.depth_at(90), FlatWall::depth, 0.1);
}

TEST(WallSigma, AnUnclearWallIsLessSureThanAClearOne) {
  FlatWall flat;
  const double clear = wall_sigma(flat.ratio, flat.domain, flat.wall).at(60, 15);
  flat.wall.confidence = HeightField(flat.wall.depth.nx, flat.wall.depth.nz, 0);
  const double unclear = wall_sigma(flat.ratio, flat.domain, flat.wall).at(60, 15);
  EXPECT_NEAR(unclear / clear, 1.8 / 0.5, 0.01);
}

TEST(WorkingGrid, IsAsCoarseAsItsTaskAllowsWhateverTheScan) {
  Grid fine;
  fine.size = {64, 64, 40};
  fine.spacing = Vec3(0.47, 0.82, 0.9);
  const Grid working = on_working_grid(Volume<float>(fine)).grid;
  EXPECT_NEAR(working.spacing[0], 1.41, 1e-9);
  EXPECT_NEAR(working.spacing[1], 1.64, 1e-9);
  EXPECT_NEAR(working.spacing[2], 2.7, 1e-9);
  Grid coarse = fine;
  coarse.spacing = Vec3(1.33, 1.33, 4);
  EXPECT_EQ(on_working_grid(Volume<float>(coarse)).grid.size, coarse.size);
}

}  // namespace
}  // namespace breast
