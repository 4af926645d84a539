// SPDX-License-Identifier: GPL-3.0-or-later
// Nipple, debris, ghosts, skin thickness and compact gland, each on a body made for it; the split of a histogram.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/units.hpp"
#include "fixtures/compact_gland.hpp"
#include "segment/body/debris.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/grid/otsu.hpp"
#include "segment/segment.hpp"
#include "segment/tissue/compact_gland.hpp"
#include "segment/tissue/dark_parts.hpp"
#include "segment/tissue/lost_edges.hpp"
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

// Haze over a shoulder has no tissue within 15 mm to be dim beside.
TEST(Debris, HazeOfFreeAirInFrontGoes) {
  Grid grid = fine_grid();
  grid.size[1] *= 2;
  const Vec3 middle = grid.to_patient(0.5 * Vec3(grid.size[0], 1.5 * grid.size[1], grid.size[2]));
  const Mask clean = ball(grid, middle, 25);
  Mask body = clean;
  add_ball(body, middle - Vec3(0, 60, 0), 12);
  Volume<float> scan(grid);
  for (std::size_t n = 0; n < scan.voxels.size(); ++n)
    scan.voxels[n] = clean.voxels[n] ? 1000.f : body.voxels[n] ? 45.f : 5.f;
  Mask kept = body;
  remove_ghosts(kept, scan);
  EXPECT_EQ(kept.voxels, body.voxels);
  remove_haze(body, scan);
  EXPECT_EQ(body.voxels, clean.voxels);
}

TEST(DarkParts, AreAirWhereOpenAndAClipWhereEnclosed) {
  const Grid grid = fine_grid();
  const Mask body = ball(grid, Vec3::Zero(), 30);
  Mask clip(grid), air(grid);
  add_ball(clip, Vec3(5, 0, 0), 6);
  add_ball(air, Vec3(0, -30, 0), 10);
  Volume<float> brightness(grid);
  for (std::size_t n = 0; n < brightness.voxels.size(); ++n) {
    const bool dark = clip.voxels[n] || air.voxels[n] || n % 97 == 0;  // noise is in single voxels
    brightness.voxels[n] = dark ? 0.05f : 1.f;
  }
  const DarkParts dark = dark_parts(brightness, body);
  const auto share_found = [&](const Mask& found, const Mask& made) {
    double both = 0, all = 0;
    for (std::size_t n = 0; n < made.voxels.size(); ++n) {
      both += made.voxels[n] && body.voxels[n] && found.voxels[n];
      all += made.voxels[n] && body.voxels[n];
    }
    return both / all;
  };
  EXPECT_EQ(share_found(dark.enclosed, clip), 1);
  EXPECT_EQ(share_found(dark.open, air), 1);
  EXPECT_EQ(share_found(dark.enclosed, air), 0);
}

/// A cube of fat under a coil's sensitivity, fivefold in 80 mm, times `brightness(p)`.
template <class Brightness>
Volume<float> cube_of_fat(const Brightness& brightness) {
  Volume<float> scan;
  scan.grid.size = {40, 40, 20};
  scan.grid.spacing = Vec3(2, 2, 4);
  scan.grid.origin = Vec3(-39, -39, -38);
  scan.voxels.resize(scan.grid.voxels());
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < 40; ++j) {
      for (int i = 0; i < 40; ++i) {
        const Vec3 p = scan.grid.to_patient(Vec3(i, j, k));
        scan.at(i, j, k) = float(200 * std::pow(5.0, -p[1] / 80) * brightness(p));
      }
    }
  }
  return scan;
}

DimTissue compact_in(const Volume<float>& scan) {
  Mask all(scan.grid);
  std::fill(all.voxels.begin(), all.voxels.end(), 1);
  return compact_gland(scan, all);
}

double ml_of(const DimTissue& gland) {
  double sum = 0;
  for (const float share : gland.share.voxels) sum += share;
  return sum * gland.share.grid.voxel_volume() / mm3_per_ml;
}

// 10 %: a fifth of a block of 4 mm all round a ball of 50 mm.
TEST(CompactGland, IsFoundByItsEdge) {
  constexpr double radius = 25;
  for (const double brightness : {0.5, 0.6, 0.7}) {
    const DimTissue found =
        compact_in(cube_of_fat([&](const Vec3& p) { return p.norm() < radius ? brightness : 1; }));
    EXPECT_NEAR(ml_of(found) / (4.18879 * std::pow(radius, 3) / mm3_per_ml), 1, 0.1) << brightness;
    EXPECT_NEAR(found.step, -std::log(brightness), 0.15) << brightness;
  }
}

TEST(CompactGland, WhatDarkensSlowlyIsTheCoil) {
  const auto field = [](const Vec3& p) {
    return 1 - 0.4 * std::exp(-p.squaredNorm() / (2 * 18 * 18));
  };
  EXPECT_EQ(ml_of(compact_in(cube_of_fat(field))), 0);
}

// Cells of 5 mm, each with another share of fat in it: no one brightness is the gland's.
TEST(CompactGland, WithFatInItIsLeftToTheFat) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.2, 1);
  std::array<std::array<std::array<double, 16>, 16>, 16> cells;
  for (auto& plane : cells)
    for (auto& row : plane)
      for (double& cell : row) cell = share(random);
  const auto mixed = [&](const Vec3& p) {
    const auto cell = [&](int d) { return std::size_t((p[d] + 40) / 5); };
    return p.norm() < 30 ? 1 - 0.5 * cells[cell(0)][cell(1)][cell(2)] : 1;
  };
  EXPECT_EQ(ml_of(compact_in(cube_of_fat(mixed))), 0);
}

TEST(LostEdges, AreThoseThatNoGlandExplains) {
  constexpr double radius = 25, brightness = 0.85;
  const Volume<float> scan =
      cube_of_fat([&](const Vec3& p) { return p.norm() < radius ? brightness : 1; });
  Mask all(scan.grid);
  std::fill(all.voxels.begin(), all.voxels.end(), 1);
  Fibroglandular gland;
  gland.gland_ratio = brightness;
  gland.fraction = Volume<float>(scan.grid);
  EXPECT_EQ(lost_edges_percent(scan, all, gland), 100);
  const Mask found = ball(scan.grid, Vec3::Zero(), radius);
  std::copy(found.voxels.begin(), found.voxels.end(), gland.fraction.voxels.begin());
  EXPECT_LT(lost_edges_percent(scan, all, gland), 10);
  EXPECT_EQ(lost_edges_percent(cube_of_fat([](const Vec3&) { return 1; }), all, gland), 0);
}

/// Volume of fibroglandular tissue that is found of a gland without fat in it, over its own. A `scale` of 0.65 is 38 %
/// of the breast, 0.78 is 66 %; `bias` is the brightness of fat at the nipple over that at the chest wall.
double compact_volume_found(double brightness, double scale = 0.65, double bias = 5) {
  testing::SyntheticScan truth;
  truth.gland_scale = scale;
  truth.bias = bias;
  Timer timer;
  const Segmentation result =
      segment_breast(testing::scan_of_compact_gland(truth, brightness), {}, no_progress(), timer);
  const testing::GlandVolume volume = testing::compact_gland_volume(truth, result.labels);
  return volume.found_ml / volume.true_ml;
}

TEST(Otsu, SplitsBetweenTheTwoHeaps) {
  EXPECT_EQ(otsu_class({5, 0, 0, 5}, 9), 1);
  EXPECT_EQ(otsu_class({0, 7, 0}, 2), 2);  // one class only
  EXPECT_EQ(otsu_class({}, 3), 3);
}

// Nearly all of each was lost: the estimate of the bias followed the gland. 7 %: a third of a voxel all round.
TEST(CompactGland, IsNotTakenForDimFat) {
  for (const double brightness : {0.5, 0.6, 0.7, 0.8, 0.85})
    EXPECT_NEAR(compact_volume_found(brightness), 1, 0.07) << brightness;
}

TEST(CompactGland, IsFoundUnderATenfoldBias) {
  EXPECT_NEAR(compact_volume_found(0.7, 0.65, 10), 1, 0.07);
}

TEST(CompactGland, IsFoundWhereItFillsMostOfTheBreast) {
  EXPECT_NEAR(compact_volume_found(0.7, 0.78), 1, 0.1);
}

}  // namespace
}  // namespace breast
