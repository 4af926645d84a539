// SPDX-License-Identifier: GPL-3.0-or-later
// Scaled Jacobian, determinants and volumes against values known by hand.
#include "mesh/quality.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "core/error.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/positivity.hpp"
#include "mesh/shape.hpp"

namespace breast {
namespace {

HexMesh one_hex() {
  HexMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                 {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
  mesh.connectivity.resize(8);
  std::iota(mesh.connectivity.begin(), mesh.connectivity.end(), 0);
  return mesh;
}

TEST(MeshQuality, BrickIsPerfect) {
  const HexMesh mesh = one_hex();
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  EXPECT_NEAR(quality.min_scaled_jacobian, 1, 1e-14);
  EXPECT_NEAR(quality.min_det, 3, 1e-13);
  EXPECT_NEAR(quality.max_det, 3, 1e-13);
  EXPECT_NEAR(mesh_volume(mesh, mesh.points), 24, 1e-12);
  EXPECT_EQ(quality.folded, 0);
}

TEST(MeshQuality, ShearedBrickIsTheSineOfItsAngle) {
  HexMesh mesh = one_hex();
  for (Vec3& x : mesh.points) x.x() += x.z() / std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(mesh_quality(mesh, mesh.points).min_scaled_jacobian, 0.5, 1e-14);
  EXPECT_NEAR(mesh_volume(mesh, mesh.points), 24, 1e-12);
}

TEST(MeshQuality, FoldedCornerIsSeen) {
  HexMesh mesh = one_hex();
  mesh.points[6] = Vec3(-1, -1, -1);
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  EXPECT_LT(quality.min_scaled_jacobian, 0);
  EXPECT_LT(quality.min_det, 0);
  EXPECT_EQ(quality.folded, 1);
  EXPECT_EQ(quality.below_01, 1);
}

TEST(MeshQuality, MirroredBrickIsNegative) {
  HexMesh mesh = one_hex();
  for (Vec3& x : mesh.points) x.x() = -x.x();
  EXPECT_NEAR(mesh_quality(mesh, mesh.points).min_scaled_jacobian, -1, 1e-14);
  EXPECT_NEAR(mesh_volume(mesh, mesh.points), -24, 1e-12);
}

HexMesh straight_27(const HexMesh& eight) {
  HexMesh mesh;
  mesh.order = 2;
  for (int a = 0; a < 27; ++a) {
    mesh.connectivity.push_back(a);
    mesh.points.push_back(element_position(eight, eight.points, 0, hex_node_local(2, a)));
  }
  return mesh;
}

TEST(JacobianBound, IsTheValueOfABrick) {
  const HexMesh mesh = one_hex();
  EXPECT_NEAR(jacobian_lower_bound(mesh, mesh.points, 0), 3, 1e-12);
  const HexMesh curved = straight_27(mesh);
  EXPECT_NEAR(jacobian_lower_bound(curved, curved.points, 0), 3, 1e-10);
}

/// Bounds are below every value and, after halving, close to the least.
TEST(JacobianBound, LiesBelowEverySample) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at(-0.7, 0.7), anywhere(-1, 1);
  int proved = 0;
  for (int trial = 0; trial < 60; ++trial) {
    HexMesh mesh = one_hex();
    if (trial % 2 == 1) mesh = straight_27(mesh);
    for (Vec3& x : mesh.points) x += Vec3(at(random), at(random), at(random)) / mesh.order;
    const double bound = jacobian_lower_bound(mesh, mesh.points, 0);
    double least = 1e9;
    for (int n = 0; n < 2000; ++n) {
      const Vec3 local(anywhere(random), anywhere(random), anywhere(random));
      const HexShape shape = hex_shape(mesh.order, local);
      Mat3 jacobian = Mat3::Zero();
      for (int a = 0; a < mesh.nodes_per_element(); ++a)
        jacobian += mesh.points[mesh.element(0)[a]] * shape.gradients.col(a).transpose();
      least = std::min(least, jacobian.determinant());
    }
    if (bound > 0) {
      ++proved;
      EXPECT_LE(bound, least + 1e-9) << trial;
    } else {
      EXPECT_LT(least, 1.0) << trial << ": not proved although far from folded";
    }
  }
  EXPECT_GT(proved, 20);
  EXPECT_LT(proved, 60);
}

/// An edge's middle node moved to its quarter: the limit of a quadratic edge.
TEST(JacobianBound, ProvesUpToTheQuarterPoint) {
  HexMesh mesh = straight_27(one_hex());
  // x = 1 + t + a (t^2 - 1) along the first edge: dx/dt = 1 + 2 a t is negative near t = -1.
  double least_at_points = 0, bound = 1;
  for (double a = 0.3; a < 0.52 && bound > 0; a += 0.005) {
    HexMesh bent = mesh;
    for (int n = 0; n < 27; ++n) {
      const Vec3 local = hex_node_local(2, n);
      bent.points[n].x() += a * (local.x() * local.x() - 1);
    }
    bound = jacobian_lower_bound(bent, bent.points, 0);
    least_at_points = mesh_quality(bent, bent.points).min_det;
    EXPECT_NEAR(bound > 0, a < 0.5, 1e-9) << a << " " << bound << " " << least_at_points;
  }
  EXPECT_LE(bound, 0);
}

TEST(MeshQuality, HistogramCountsEveryElement) {
  HexMesh mesh = one_hex();
  for (Vec3& x : mesh.points) x.x() += x.z() / std::tan(std::numbers::pi / 6);
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  EXPECT_EQ(std::accumulate(quality.histogram.begin(), quality.histogram.end(), 0), 1);
  EXPECT_EQ(quality.histogram[4] + quality.histogram[5], 1);
}

TEST(MeshQuality, NotANumberIsFolded) {
  HexMesh mesh = one_hex();
  mesh.points[3].z() = std::nan("");
  EXPECT_EQ(mesh_quality(mesh, mesh.points).folded, 1);
}

TEST(MeshQuality, EmptyMeshIsRefused) {
  EXPECT_THROW(mesh_quality(HexMesh{}, {}), Error);
}

}  // namespace
}  // namespace breast
