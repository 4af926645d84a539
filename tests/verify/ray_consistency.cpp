// SPDX-License-Identifier: GPL-3.0-or-later
// What an image must not depend on: where body and machine stand together, and, in the end, the
// size of its pixels.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "fixtures/analytic_breast.hpp"
#include "fixtures/squashed.hpp"
#include "fixtures/traced.hpp"
#include "meshing/body_mesh.hpp"
#include "projection/framing.hpp"
#include "projection/projection.hpp"
#include "projection/ray_mesh.hpp"

using namespace breast;
using namespace breast::fixtures;

namespace {

const HexMesh& body(int order) {
  static const HexMesh linear = body_mesh(analytic_breast(), {.size = dome_near(10)});
  static const HexMesh curved = body_mesh(analytic_breast(), {.size = dome_near(5), .order = 2});
  return order == 1 ? linear : curved;
}

class Moved : public testing::TestWithParam<std::tuple<int, Beam>> {};

}  // namespace

// Turned by an angle that is no view's and carried away, body and machine together.
TEST_P(Moved, BodyAndMachineTogetherGiveTheSameImage) {
  const auto [order, beam] = GetParam();
  HexMesh mesh = squashed(body(order), View::mlo, 0.6);
  const ViewPose pose = image_frame(mesh, beam).pose;
  const RayMesh rays(mesh, mesh.points, pose);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(0.3, -0.8, 0.52).normalized()).toRotationMatrix();
  const Vec3 carry(310, -77, 145);
  ViewPose moved = pose;
  moved.n = turn * pose.n;
  moved.e_u = turn * pose.e_u;
  moved.e_v = turn * pose.e_v;
  moved.origin = turn * pose.origin + carry;
  for (Vec3& x : mesh.points) x = turn * x + carry;
  const RayMesh elsewhere(mesh, mesh.points, moved);
  double most = 0;
  for (double u = 1.37; u < 70; u += 2.9) {
    for (double v = -3.1; v < 160; v += 3.7) {
      const double t = traced(rays, {u, v});
      most = std::max(most, t);
      // Rays step aside by up to 1e-6 mm; at the rim chords change a hundred times as fast.
      ASSERT_NEAR(traced(elsewhere, {u, v}), t, 1e-4) << u << " " << v;
    }
  }
  EXPECT_GT(most, 30);
}

INSTANTIATE_TEST_SUITE_P(Consistency, Moved,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values(Beam::parallel, Beam::cone)));

// An image is constant within a pixel: its distance to the rays between the centres, averaged over
// the image, falls with the pixel. (Of pixels' means over the body's rim it cannot fall faster.)
TEST(Consistency, ImageConvergesWithThePixel) {
  const HexMesh mesh = squashed(body(1), View::cc, 0.6);
  std::vector<double> error;
  for (const double pixel : {2.0, 1.0, 0.5}) {
    const Mammogram image = project_mammogram(mesh, {.pixel = pixel});
    const RayMesh rays(mesh, mesh.points, image.pose);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> column(0, image.width - 1), row(0, image.height - 1);
    double sum = 0;
    constexpr int draws = 4000;
    for (int i = 0; i < draws; ++i) {
      const Vec2 at(column(random), row(random));
      const std::size_t nearest =
          std::size_t(std::lround(at.y())) * image.width + std::size_t(std::lround(at.x()));
      sum += std::abs(image.thickness[nearest] - traced(rays, pixel * at));
    }
    error.push_back(sum / draws);
  }
  EXPECT_NEAR(error[0] / error[1], 2, 0.35);
  EXPECT_NEAR(error[1] / error[2], 2, 0.35);
  EXPECT_LT(error[2], 0.35);
}
