// SPDX-License-Identifier: GPL-3.0-or-later
// What rays measure against what is known exactly: the volume of a deformed breast as the integral
// of its chords, for both beams, and chords of block and ball for the point source.
#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/analytic_breast.hpp"
#include "fixtures/block.hpp"
#include "fixtures/squashed.hpp"
#include "fixtures/traced.hpp"
#include "meshing/body_mesh.hpp"
#include "projection/framing.hpp"
#include "projection/ray_mesh.hpp"

using namespace breast;
using namespace breast::fixtures;

namespace {

HexMesh compressed_breast(View view) {
  return squashed(body_mesh(analytic_breast(), {.size = dome_near(10)}), view, 0.6);
}

// ∫ dV over the chord's cone: a pixel's beam is (1 + t/D)² as wide at height −t as on the detector;
// t is measured along the beam axis, d = t · stretch along the ray.
double beam_volume(const Chord& chord, double source_distance, double stretch) {
  if (!(source_distance > 0)) return chord.leave - chord.enter;
  const auto cube = [&](double d) { return std::pow(1 + d / (stretch * source_distance), 3); };
  return source_distance / 3 * (cube(chord.leave) - cube(chord.enter));
}

// Midpoint rule over the whole projection.
double measured_volume(const RayMesh& rays, const ViewPose& pose, double pixel) {
  std::vector<Chord> chords;
  double sum = 0;
  for (double u = -160 + 0.5 * pixel; u < 160; u += pixel) {
    for (double v = -160 + 0.5 * pixel; v < 320; v += pixel) {
      rays.trace({u, v}, chords);
      if (chords.empty()) continue;
      const double slope = std::hypot(u, v - pose.source_v) / std::max(pose.source_distance, 1.0);
      const double stretch = std::hypot(1.0, slope);
      for (const Chord& chord : chords) sum += beam_volume(chord, pose.source_distance, stretch);
    }
  }
  return sum * pixel * pixel;
}

}  // namespace

TEST(RayVolume, ChordsOfABreastAddUpToItsVolume) {
  const HexMesh mesh = compressed_breast(View::mlo);
  for (const Beam beam : {Beam::parallel, Beam::cone}) {
    const ViewPose pose = image_frame(mesh, beam).pose;
    const RayMesh rays(mesh, mesh.points, pose);
    const double coarse = std::abs(measured_volume(rays, pose, 1.0) / rays.volume() - 1);
    const double fine = std::abs(measured_volume(rays, pose, 0.4) / rays.volume() - 1);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, 1e-4);
  }
}

TEST(RayVolume, PointSourceChordsOfABlockAreExact) {
  BlockSettings settings;
  settings.elements = {4, 5, 3};
  settings.size = {60, 80, 40};
  HexMesh mesh = block(settings);
  add_contact(mesh, View::cc);
  ViewPose pose = view_pose(Side::left, 20);
  pose.origin = Vec3(10, 40, -30);
  pose.source_distance = 650;
  pose.source_v = 12;
  const RayMesh rays(mesh, mesh.points, pose);
  int hits = 0;
  for (double u = -70; u < 70; u += 3.1) {
    for (double v = -70; v < 70; v += 2.7) {
      const Ray ray = rays.ray({u, v});
      double enter = -1e9, leave = 1e9;
      for (int k = 0; k < 3; ++k) {
        const double a = -ray.origin[k] / ray.direction[k],
                     b = (settings.size[k] - ray.origin[k]) / ray.direction[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      const double sum = traced(rays, {u, v});
      ASSERT_NEAR(sum, std::max(0.0, leave - enter), 1e-8) << u << " " << v;
      hits += sum > 0;
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(RayVolume, PointSourceChordsOfABallConvergeWithTheElements) {
  const double radius = 50;
  double worst[2] = {0, 0};
  for (const int n : {8, 16}) {
    BlockSettings settings;
    settings.elements = {n, n, n};
    settings.size = {2, 2, 2};
    HexMesh mesh = block(settings);
    for (Vec3& x : mesh.points) x = radius * ball_from_cube(x - Vec3::Ones());
    ViewPose pose = view_pose(Side::right, 45);
    pose.source_distance = 650;
    pose.origin = 60 * pose.n;
    const RayMesh rays(mesh, mesh.points, pose);
    for (double u = -40; u < 40; u += 2.3) {
      for (double v = -20; v < 20; v += 2.9) {
        const Ray ray = rays.ray({u, v});
        const double along = ray.origin.dot(ray.direction);
        const double inside = along * along - ray.origin.squaredNorm() + radius * radius;
        const double sum = traced(rays, {u, v});
        double& error = worst[n == 16];
        error = std::max(error, std::abs(sum - 2 * std::sqrt(inside)));
      }
    }
  }
  EXPECT_LT(worst[1], 0.8);
  EXPECT_LT(worst[1], 0.35 * worst[0]);  // second order: facets of a sphere
}
