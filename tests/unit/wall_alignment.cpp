// SPDX-License-Identifier: GPL-3.0-or-later
// Rib cages laid over each other by their chest walls: known motions, what a wall cannot tell, walls that do not fit.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "identification/wall_alignment.hpp"
#include "identification/wall_map.hpp"

using namespace breast;

namespace {

constexpr double tissue_mm = 20;

// An elliptic chest, maybe bent along the body, under 20 mm of fat.
double wall_depth(double x, double z, double bend) {
  const double u = std::min(0.98, std::abs(x - 60) / 150);
  return 110 * (1 - std::sqrt(1 - u * u)) + bend * z * z + 1.5 * std::exp(-x * x / 225);
}

// Labels of the body that `moved` put into the scanner; `also` may change the wall's depth.
LabelVolume labels_of(const RigidMotion& moved, double bend,
                      const std::function<double(double, double)>& also = {}) {
  LabelVolume labels;
  labels.grid.size = {75, 100, 50};
  labels.grid.spacing = Vec3(2, 1, 3);
  labels.grid.origin = Vec3(-15, -40, -75);
  labels.chest_wall_confidence.assign(labels.grid.voxels(), 1);
  labels.tissue.assign(labels.grid.voxels(), std::uint8_t(Tissue::air));
  for (int k = 0; k < labels.grid.size[2]; ++k)
    for (int j = 0; j < labels.grid.size[1]; ++j)
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        const Vec3 x = moved.origin_of(labels.grid.to_patient(Vec3(i, j, k)));
        const double behind =
            x.y() - wall_depth(x.x(), x.z(), bend) - (also ? also(x.x(), x.z()) : 0);
        if (behind < -tissue_mm) continue;
        labels.tissue[labels.grid.offset(i, j, k)] =
            std::uint8_t(behind < 0 ? Tissue::fat : Tissue::muscle);
      }
  return labels;
}

RigidMotion motion(const Vec3& shift, const Vec3& turn) {
  return {.centre = Vec3(60, 20, 0), .shift = shift, .turn = turn};
}

// How far two motions put the wall apart along its normal, at worst.
double worst_off_wall(const LabelVolume& labels, const RigidMotion& a, const RigidMotion& b) {
  const WallMap wall(labels);
  double worst = 0;
  for (const Vec3& place : wall.places(15)) {
    const auto found = wall.distance(a.origin_of(b(place)));
    if (found) worst = std::max(worst, std::abs(found->value));
  }
  return worst;
}

}  // namespace

TEST(WallAlignment, LaysAMovedWallOverTheOther) {
  const RigidMotion truth = motion(Vec3(1.5, -3, 2), Vec3(1.2, -0.8, 1));
  const LabelVolume first = labels_of(motion(Vec3::Zero(), Vec3::Zero()), 2e-3);
  const WallAlignment found = align_walls(first, labels_of(truth, 2e-3), truth.centre, 4, 2);
  EXPECT_GT(found.places, 50);
  EXPECT_LT(found.residual_mm, 0.3);
  EXPECT_LT(worst_off_wall(first, found.motion, truth), 0.6);
  for (int k = 0; k < 6; ++k) {
    const double off = k < 3 ? found.motion.shift[k] - truth.shift[k]
                             : found.motion.turn[k - 3] - truth.turn[k - 3];
    EXPECT_LT(std::abs(off), 2.5 * found.deviation(k)) << found.words()[std::size_t(k)];
  }
  EXPECT_GT(found.from_walls[1], 0.9);  // front to back
}

TEST(WallAlignment, SaysThatACylinderTellsNothingAlongItself) {
  const RigidMotion truth = motion(Vec3(0, -3, 3), Vec3(1, 0, 0));
  const WallAlignment found = align_walls(labels_of(motion(Vec3::Zero(), Vec3::Zero()), 0),
                                          labels_of(truth, 0), truth.centre, 4, 2);
  EXPECT_LT(found.from_walls[2], 0.3);
  EXPECT_NE(found.words()[2].find("not determined by the walls"), std::string::npos)
      << found.words()[2];
  EXPECT_NEAR(found.motion.shift.y(), -3, 0.5);
  EXPECT_NEAR(found.motion.turn.x(), 1, 0.3);
}

TEST(WallAlignment, LeavesOutWhatDoesNotFit) {
  const RigidMotion truth = motion(Vec3(1, -2, 0), Vec3(0.5, 0, 0));
  const LabelVolume first = labels_of(motion(Vec3::Zero(), Vec3::Zero()), 2e-3);
  // A muscle taken for tissue over a part of the wall.
  const LabelVolume second = labels_of(
      truth, 2e-3, [](double x, double z) { return std::hypot(x - 90, z - 30) < 22 ? 9.0 : 0.0; });
  const WallAlignment found = align_walls(first, second, truth.centre, 4, 2);
  EXPECT_GT(found.left_out_percent, 3);
  EXPECT_LT(worst_off_wall(first, found.motion, truth), 1.2);
}

TEST(WallAlignment, TakesTheFramesOverMidlineAndSternum) {
  RigidMotion truth = motion(Vec3(1, -120, 0), Vec3(0.5, 0, 0));
  const LabelVolume still = labels_of(motion(Vec3::Zero(), Vec3::Zero()), 2e-3);
  LabelVolume first = still, second = labels_of(motion(Vec3(1, 0, 0), Vec3(0.5, 0, 0)), 2e-3);
  second.grid.origin.y() -= 120;
  first.midline_mm = 0, second.midline_mm = 1;
  const WallAlignment found = align_walls(first, second, truth.centre, 4, 2);
  EXPECT_NEAR(found.laid_over[1], -120, 3);
  EXPECT_LT(worst_off_wall(first, found.motion, truth), 0.8);
  first.midline_mm.reset();
  EXPECT_THROW(align_walls(first, second, truth.centre, 4, 2), Error);  // walls 120 mm apart
}

TEST(WallAlignment, RefusesWallsThatDoNotMeet) {
  const LabelVolume still = labels_of(motion(Vec3::Zero(), Vec3::Zero()), 0);
  LabelVolume unsure = still;
  unsure.chest_wall_confidence.assign(unsure.grid.voxels(), 0.2f);
  EXPECT_THROW(align_walls(still, unsure, Vec3(60, 20, 0), 4, 2), Error);
}
