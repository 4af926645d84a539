// SPDX-License-Identifier: GPL-3.0-or-later
// How far tissue moves and how near it comes to the ribs, on a cylinder where both are known.
#include "evaluation/posture_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"
#include "evaluation/spread.hpp"
#include "fixtures/block.hpp"

namespace breast {
namespace {

constexpr double radius = 100;

ThoraxSurface cylinder() {
  ThoraxSurface surface;
  surface.angle_low = -2, surface.angle_high = 2;
  surface.height_low = -200, surface.height_high = 200;
  surface.angles = 12, surface.heights = 12;
  surface.coefficients.assign(15 * 15, radius);
  return surface;
}

/// A slab 60 mm thick on the front of the cylinder.
HexMesh slab() {
  fixtures::BlockSettings settings;
  settings.elements = {6, 8, 4};
  settings.size = Vec3(60, 0.8, 50);
  HexMesh mesh = fixtures::block(settings);
  for (Vec3& p : mesh.imaged) {
    const double r = radius + p.x(), angle = p.y() - 0.4;
    p = Vec3(r * std::sin(angle), -r * std::cos(angle), p.z() - 25);
  }
  mesh.points = mesh.reference = mesh.imaged;
  mesh.side = Side::left;
  mesh.geometry.emplace().thorax = cylinder();
  mesh.landmarks.push_back({"nipple", mesh.imaged.front(), 0, Vec3(1, 0, 0), 0});
  return mesh;
}

TEST(Spread, CountsEveryValueByItsWeight) {
  const Spread equal = spread({{1}, {2}, {6}});
  EXPECT_NEAR(equal.mean, 3, 1e-15);
  EXPECT_NEAR(equal.sd, std::sqrt(7.0), 1e-14);
  // A weight of two is a value that occurs twice; one without weight does not exist.
  const Spread weighted = spread({{1, 2}, {4, 1}, {100, 0}});
  EXPECT_NEAR(weighted.mean, 2, 1e-15);
  EXPECT_NEAR(weighted.sd, 2, 1e-14);
  EXPECT_EQ(weighted.low, 1);
  EXPECT_EQ(weighted.high, 4);
  EXPECT_EQ(spread({{5, 0.1}}).sd, 0);
  EXPECT_EQ(spread({{5, 0}}).mean, 0);
}

TEST(PostureMotion, DistancesFromACylinder) {
  const ThoraxSurface surface = cylinder();
  for (const double above : {-20.0, 0.0, 15.0, 80.0}) {
    const Vec3 x((radius + above) * std::sin(0.7), -(radius + above) * std::cos(0.7), 12);
    EXPECT_NEAR(wall_surface_distance(surface, x), above, 1e-6);
  }
  EXPECT_THROW(wall_surface_distance(surface, Vec3(0, -150, 900)), Error);
}

TEST(PostureMotion, TurningAboutTheWallKeepsTheDistances) {
  HexMesh mesh = slab();
  const double angle = 0.5;
  for (Vec3& p : mesh.points) p = (Eigen::AngleAxisd(angle, Vec3::UnitZ()) * p).eval();
  const PostureMotion motion = posture_motion(mesh, 5);
  EXPECT_NEAR(motion.ribs_after, motion.ribs_before, 1e-6);
  EXPECT_NEAR(motion.ratio, 1, 1e-6);
  const Landmark& nipple = *mesh.landmark("nipple");
  EXPECT_NEAR(motion.nipples_apart_before,
              2 * std::abs(landmark_position(mesh, mesh.imaged, nipple).x()), 1e-9);
  EXPECT_NEAR(motion.nipples_apart_after,
              2 * std::abs(landmark_position(mesh, mesh.points, nipple).x()), 1e-9);
  EXPECT_NEAR(motion.before_notch_before - motion.before_notch_after, motion.nipple_posterior,
              1e-9);
  EXPECT_GT(motion.nipple_lateral, 30) << "to the left, away from the midline";
  EXPECT_NEAR(motion.nipple_caudal, 0, 1e-9);
  ASSERT_EQ(motion.bins.size(), 3u);
  double fraction = 0;
  for (const DepthBin& bin : motion.bins) {
    EXPECT_NEAR(bin.change, 0, 1e-6);
    EXPECT_GT(bin.moved, radius * 2 * std::sin(angle / 2));
    fraction += bin.fraction;
  }
  EXPECT_NEAR(fraction, 1, 1e-12);
  mesh.side = Side::right;
  EXPECT_NEAR(posture_motion(mesh, 5).nipple_lateral, -motion.nipple_lateral, 1e-12);
}

TEST(PostureMotion, FlatteningBringsTissueToTheRibs) {
  HexMesh mesh = slab();
  for (Vec3& p : mesh.points) {
    const double r = std::hypot(p.x(), p.y());
    const double flat = radius + 0.5 * (r - radius);
    p.head<2>() *= flat / r;
  }
  const PostureMotion motion = posture_motion(mesh, 0);
  EXPECT_NEAR(motion.ratio, 0.5, 1e-2);
  EXPECT_LT(motion.bins[2].change, motion.bins[0].change);
  EXPECT_NEAR(motion.ribs_after, 0.5 * motion.ribs_before, 0.1);
  // The change is proportional to the distance, so that the regression over 40 to 60 mm is exact beyond.
  EXPECT_NEAR(motion.far_change, -0.5 * far_landmark_mm, 0.2);
}

TEST(PostureMotion, NeedsAWallSurfaceAndANipple) {
  HexMesh mesh = slab();
  mesh.landmarks.clear();
  EXPECT_THROW(posture_motion(mesh, 5), Error);
  mesh = slab();
  mesh.geometry.reset();
  EXPECT_THROW(posture_motion(mesh, 5), Error);
}

}  // namespace
}  // namespace breast
