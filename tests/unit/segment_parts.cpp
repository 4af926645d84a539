// SPDX-License-Identifier: GPL-3.0-or-later
// Nipple, debris, ghosts and skin thickness, each on a body made for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segment/body/debris.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/tissue/nipple.hpp"
#include "segment/tissue/skin_thickness.hpp"

namespace breast {
namespace {

/// A solid ball with a small cylinder (papilla) or crumb on it.
Mask ball(const Grid& grid, const Vec3& centre, double radius) {
  Mask mask(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i)
        mask.at(i, j, k) = (grid.to_patient(Vec3(i, j, k)) - centre).norm() < radius;
    }
  }
  return mask;
}

Grid fine_grid() {
  Grid grid;
  grid.size = {120, 70, 40};
  grid.spacing = Vec3(1, 1, 2.5);
  grid.origin = Vec3(-59.5, -49.5, -48.75);
  return grid;
}

void add_ball(Mask& mask, const Vec3& centre, double radius) {
  const Mask more = ball(mask.grid, centre, radius);
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) mask.voxels[n] |= more.voxels[n];
}

TEST(Nipple, PapillaAwayFromTheMostAnteriorPoint) {
  const Grid grid = fine_grid();
  const double radius = 42, tilt = 0.3;
  Mask body = ball(grid, Vec3::Zero(), radius);
  const Vec3 axis(std::sin(tilt), -std::cos(tilt), 0), tip = (radius + 5) * axis;
  for (double h = 0; h <= 1; h += 0.25) add_ball(body, (radius - 4 + 4 * h) * axis, 5);
  const Nipple nipple = find_nipple(body, body);
  EXPECT_LT((nipple.tip - tip).norm(), 1.5);
  EXPECT_NEAR(nipple.height, 5, 1.5);
  EXPECT_LT((nipple.base - radius * axis).norm(), 1.5);
}

TEST(Nipple, SmoothDomeHasItAtTheFront) {
  const Mask body = ball(fine_grid(), Vec3::Zero(), 42);
  const Nipple nipple = find_nipple(body, body);
  EXPECT_LT((nipple.tip - Vec3(0, -42, 0)).norm(), 6);
  EXPECT_LT(nipple.height, 1.5);
}

TEST(Debris, CrumbsGoAndNipplesStay) {
  const Grid grid = fine_grid();
  Mask body = ball(grid, Vec3::Zero(), 40);
  const Mask clean = body;
  add_ball(body, Vec3(41, -5, 1.25), 2.6);  // a marker on the flank
  Mask with_papilla = body;
  add_ball(with_papilla, Vec3(0, -40, 1.25), 3.2);
  EXPECT_GT(remove_debris(body, 119), 0);
  double left = 0;
  for (std::size_t n = 0; n < body.voxels.size(); ++n) left += body.voxels[n] != clean.voxels[n];
  EXPECT_LT(left, 12) << "voxels still beyond the ball";
  const Mask before = with_papilla;
  remove_debris(with_papilla, 119);
  EXPECT_EQ(with_papilla.at(60, 7, 20), before.at(60, 7, 20));
  EXPECT_EQ(before.at(60, 7, 20), 1);
}

/// A ball of fat in a layer of skin, as a scanner sees it: every voxel the mean of its parts.
Volume<float> skinned_ball(double radius, double thickness, double skin_to_fat) {
  Volume<float> image(fine_grid());
  const Vec3& spacing = image.grid.spacing;
  for (int k = 0; k < image.grid.size[2]; ++k) {
    for (int j = 0; j < image.grid.size[1]; ++j) {
      for (int i = 0; i < image.grid.size[0]; ++i) {
        const Vec3 centre = image.grid.to_patient(Vec3(i, j, k));
        const double off = centre.norm() - radius;
        const int parts = off > -thickness - 2 && off < 2 ? 5 : 1;
        double sum = 0;
        for (int n = 0; n < parts * parts * parts; ++n) {
          const Vec3 at(n % parts, n / parts % parts, n / parts / parts);
          const Vec3 part = (at + Vec3::Constant(0.5)) / parts - Vec3::Constant(0.5);
          const double depth = radius - (centre + spacing.cwiseProduct(part)).norm();
          sum += depth < 0 ? 0 : depth < thickness ? skin_to_fat : 1;
        }
        image.at(i, j, k) = float(sum / (parts * parts * parts));
      }
    }
  }
  return image;
}

/// From half a voxel to three: the layer's thickness, and none where there is none.
TEST(Skin, ThicknessOfKnownLayers) {
  const double radius = 35;
  const Mask body = ball(fine_grid(), Vec3::Zero(), radius);
  const Volume<float> distance = signed_distance(body);
  for (const double thickness : {0.5, 0.8, 1.5, 3.0}) {
    const Volume<float> image = skinned_ball(radius, thickness, 0.5);
    EXPECT_NEAR(skin_thickness(image, body, distance), thickness, 0.15);
  }
  EXPECT_LT(skin_thickness(skinned_ball(radius, 0, 0.5), body, distance), 0.15);
  for (const double skin : {0.4, 0.6}) {
    const Volume<float> image = skinned_ball(radius, 1.5, skin);
    EXPECT_NEAR(skin_thickness(image, body, distance), 1.5, 0.25) << "not as bright as assumed";
  }
}

TEST(Skin, WithoutFatBehindItIsNotMeasured) {
  const Mask body = ball(fine_grid(), Vec3::Zero(), 35);
  Volume<float> dark = skinned_ball(35, 1.5, 0.5);
  for (float& v : dark.voxels) v *= 0.5f;
  EXPECT_EQ(skin_thickness(dark, body, signed_distance(body)), 0);
}

TEST(Debris, DimGhostBesideTheBodyGoes) {
  const Grid grid = fine_grid();
  const Mask clean = ball(grid, Vec3::Zero(), 30);
  Mask body = clean;
  add_ball(body, Vec3(34, 0, 0), 10);  // too thick for an opening
  Volume<float> scan(grid);
  for (std::size_t n = 0; n < scan.voxels.size(); ++n)
    scan.voxels[n] = clean.voxels[n] ? 1000.f : body.voxels[n] ? 80.f : 5.f;
  remove_ghosts(body, scan);
  EXPECT_EQ(body.voxels, clean.voxels);
}

}  // namespace
}  // namespace breast
