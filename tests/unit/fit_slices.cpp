// SPDX-License-Identifier: GPL-3.0-or-later
// Shape-based interpolation between thick slices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "fit/slice_interpolation.hpp"

using namespace breast;

namespace {

Volume<float> mask_of(const Grid& grid, const std::function<bool(const Vec3&)>& inside) {
  Volume<float> mask(grid);
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
        mask.at(i, j, k) = inside(grid.to_patient(Vec3(i, j, k))) ? 1.f : 0.f;
  return mask;
}

Grid thick_grid() {
  Grid grid;
  grid.size = {60, 50, 12};
  grid.spacing = Vec3(1, 1.2, 4);
  return grid;
}

}  // namespace

TEST(SliceInterpolation, AnObliquePlaneStaysAPlane) {
  // Falls 3 mm in y over one slice: as a staircase the error would reach 1.5 mm.
  const auto surface = [](const Vec3& p) { return p.y() - 10 - 0.75 * p.z(); };
  const Volume<float> filled =
      fill_between_slices(mask_of(thick_grid(), [&](const Vec3& p) { return surface(p) > 0; }));
  ASSERT_EQ(filled.grid.size[2], 34);
  EXPECT_NEAR(filled.grid.spacing.z(), 4.0 / 3, 1e-12);
  for (int k = 0; k < filled.grid.size[2]; ++k)
    for (int j = 0; j < filled.grid.size[1]; ++j)
      for (int i = 10; i < 50; ++i) {
        const double d = surface(filled.grid.to_patient(Vec3(i, j, k)));
        if (std::abs(d) > 1.3) {
          EXPECT_EQ(filled.at(i, j, k) > 0.5f, d > 0) << i << " " << j << " " << k;
        }
      }
}

TEST(SliceInterpolation, KeepsTheSlicesThemselves) {
  const auto ball = [](const Vec3& p) { return (p - Vec3(30, 28, 22)).norm() < 19; };
  const Volume<float> mask = mask_of(thick_grid(), ball);
  const Volume<float> filled = fill_between_slices(mask);
  for (int k = 0; k < mask.grid.size[2]; ++k)
    for (int j = 0; j < mask.grid.size[1]; ++j)
      for (int i = 0; i < mask.grid.size[0]; ++i)
        ASSERT_EQ(filled.at(i, j, 3 * k) > 0.5f, mask.at(i, j, k) > 0.5f);
}

TEST(SliceInterpolation, WorksAlongAnyAxisAndLeavesThinSlicesAlone) {
  Grid grid = thick_grid();
  grid.size = {12, 60, 50};
  grid.spacing = Vec3(4, 1, 1);
  const auto ball = [](const Vec3& p) { return (p - Vec3(22, 30, 25)).norm() < 19; };
  const Volume<float> filled = fill_between_slices(mask_of(grid, ball));
  EXPECT_EQ(filled.grid.size[0], 45);
  double volume = 0;
  for (const float v : filled.voxels) volume += v * filled.grid.voxel_volume();
  EXPECT_NEAR(volume / (4.0 / 3 * M_PI * 19 * 19 * 19), 1, 0.04);
  grid.spacing = Vec3(1.2, 1, 1);
  const Volume<float> even = mask_of(grid, ball);
  EXPECT_EQ(fill_between_slices(even).voxels, even.voxels);
}

TEST(SliceInterpolation, EmptyAndFullSlicesAreNoTrouble) {
  const Volume<float> none =
      fill_between_slices(mask_of(thick_grid(), [](const Vec3&) { return false; }));
  const Volume<float> all =
      fill_between_slices(mask_of(thick_grid(), [](const Vec3&) { return true; }));
  EXPECT_EQ(*std::max_element(none.voxels.begin(), none.voxels.end()), 0.f);
  EXPECT_EQ(*std::min_element(all.voxels.begin(), all.voxels.end()), 1.f);
}
