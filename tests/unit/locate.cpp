// SPDX-License-Identifier: GPL-3.0-or-later
// Point location against brute force, on linear and curved quadratic meshes.
#include "mesh/locate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "mesh/quality.hpp"
#include "mesh/shape.hpp"

namespace breast {
namespace {

// Cells × cells × cells over [0,1]^3 of order 1 or 2, bent by a smooth map.
HexMesh bent_block(int order, int cells) {
  HexMesh mesh;
  mesh.order = order;
  const int side = order * cells + 1;
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const Vec3 at = Vec3(i, j, k) / double(side - 1);
        mesh.points.push_back(at + 0.08 * Vec3(std::sin(5 * at.y()) * at.z(), std::sin(4 * at.x()),
                                               std::cos(5 * at.x()) * std::sin(3 * at.y())));
      }
    }
  }
  for (int e = 0; e < cells * cells * cells; ++e) {
    const Eigen::Vector3i cell(e % cells, (e / cells) % cells, e / (cells * cells));
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      const Vec3 local = hex_node_local(order, a);
      Eigen::Vector3i at;
      for (int d = 0; d < 3; ++d)
        at[d] = order * cell[d] + int(std::lround(0.5 * order * (local[d] + 1)));
      mesh.connectivity.push_back((at[2] * side + at[1]) * side + at[0]);
    }
  }
  return mesh;
}

class LocateOrder : public testing::TestWithParam<int> {};

TEST_P(LocateOrder, MaterialPointsComeBack) {
  const HexMesh mesh = bent_block(GetParam(), 5);
  const Locator locator(mesh, mesh.points);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.999, 0.999);
  for (int trial = 0; trial < 2000; ++trial) {
    const int element = trial % mesh.elements();
    const Vec3 local(uniform(random), uniform(random), uniform(random));
    const Vec3 point = element_position(mesh, mesh.points, element, local);
    const auto found = locator.find(point);
    ASSERT_TRUE(found) << "trial " << trial;
    EXPECT_EQ(found->element, element);
    EXPECT_LT((found->local - local).norm(), 1e-10);
    EXPECT_EQ(found->moved, 0);
  }
}

TEST_P(LocateOrder, SharedCornersBelongToTheLowestElement) {
  const HexMesh mesh = bent_block(GetParam(), 3);
  const Locator locator(mesh, mesh.points);
  for (int node = 0; node < mesh.nodes(); ++node) {
    int lowest = -1;
    for (int e = mesh.elements() - 1; e >= 0; --e) {
      for (int a = 0; a < mesh.nodes_per_element(); ++a) {
        if (mesh.element(e)[a] == node) lowest = e;
      }
    }
    const auto found = locator.find(mesh.points[node]);
    ASSERT_TRUE(found) << "node " << node;
    EXPECT_EQ(found->element, lowest);
    EXPECT_LT((locator.position(found->element, found->local) - mesh.points[node]).norm(), 1e-9);
  }
}

TEST_P(LocateOrder, OutsidePointsMoveToTheNearestPoint) {
  const HexMesh mesh = bent_block(GetParam(), 4);
  const Locator locator(mesh, mesh.points);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 40; ++trial) {
    const Vec3 way = Vec3(normal(random), normal(random), normal(random)).normalized();
    const Vec3 point = Vec3(0.5, 0.5, 0.5) + 1.3 * way;
    ASSERT_FALSE(locator.find(point));
    const Location found = locator.nearest(point);
    double brute = 1e9;  // fine samples of every element
    for (int e = 0; e < mesh.elements(); ++e) {
      for (int s = 0; s < 11 * 11 * 11; ++s) {
        const Vec3 local = Vec3(s % 11, (s / 11) % 11, s / 121) / 5.0 - Vec3::Ones();
        brute = std::min(brute, (element_position(mesh, mesh.points, e, local) - point).norm());
      }
    }
    EXPECT_LE(found.moved, brute + 1e-9);
    EXPECT_GT(found.moved, brute - 0.01);
    EXPECT_NEAR((locator.position(found.element, found.local) - point).norm(), found.moved, 1e-12);
  }
}

TEST_P(LocateOrder, HintChangesNothing) {
  const HexMesh mesh = bent_block(GetParam(), 4);
  const Locator locator(mesh, mesh.points);
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3 point = 0.97 * mesh.points[node] + 0.03 * Vec3(0.5, 0.5, 0.5);
    const auto plain = locator.find(point);
    for (int hint = -1; hint < mesh.elements(); hint += 7) {
      const auto hinted = locator.find(point, hint);
      ASSERT_EQ(plain.has_value(), hinted.has_value());
      if (plain) {
        EXPECT_EQ(plain->element, hinted->element);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, LocateOrder, testing::Values(1, 2));

TEST(Locate, AgreesWithBruteForceOnABreast) {
  const HexMesh mesh = analytic_breast_mesh(8);
  const Locator locator(mesh, mesh.points);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  int inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 share(uniform(random), uniform(random), uniform(random));
    const Vec3 point = locator.lower() + share.cwiseProduct(locator.upper() - locator.lower());
    const auto found = locator.find(point);
    inside += found.has_value();
    if (!found) {
      EXPECT_GT(locator.nearest(point).moved, 0);
    }
  }
  // The share of the box's points found inside is the share of its volume.
  const double box = (locator.upper() - locator.lower()).prod();
  EXPECT_NEAR(inside / 3000.0, mesh_volume(mesh, mesh.points) / box, 0.03);
}

TEST(Locate, NearestOnFacesStaysOnTheFaces) {
  const HexMesh mesh = analytic_breast_mesh(8);
  const Vec3 inside(3, 20, -5);
  const Location on_skin = nearest_on_faces(mesh, mesh.points, mesh.skin_faces, inside);
  EXPECT_GT(on_skin.moved, 5);
  EXPECT_NEAR((element_position(mesh, mesh.points, on_skin.element, on_skin.local) - inside).norm(),
              on_skin.moved, 1e-12);
  for (const int node : nodes_of(mesh, mesh.skin_faces)) {
    EXPECT_LE(on_skin.moved, (mesh.points[node] - inside).norm() + 1e-12);
  }
}

TEST(Locate, RefusesNonFinitePositions) {
  HexMesh mesh = bent_block(1, 2);
  mesh.points[5].y() = std::nan("");
  EXPECT_THROW(Locator(mesh, mesh.points), Error);
  EXPECT_THROW(Locator(HexMesh{}, {}), Error);
}

}  // namespace
}  // namespace breast
