// SPDX-License-Identifier: GPL-3.0-or-later
// The tissue around the breast: its elements, and the breast without them.
#include "mesh/surroundings.hpp"
#include "mesh/part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/boundary_sets.hpp"
#include "fixtures/renumbered.hpp"
#include "mesh/muscle_front.hpp"
#include "mesh/nodal.hpp"
#include "mesh/quality.hpp"
#include "meshing/body_mesh.hpp"
#include "meshing/layers/muscle_layer.hpp"
#include "meshing/layers/surrounding_layers.hpp"
#include "meshing/skin.hpp"
#include "surface/thorax.hpp"

namespace breast {
namespace {

/// An analytic breast that ends well within its sheets.
BreastGeometry narrower_breast() {
  constexpr double share = 0.8;
  BreastGeometry geometry = analytic_breast();
  const Vec2 wall =
      std::accumulate(geometry.rim_wall.begin(), geometry.rim_wall.end(), Vec2(0, 0)) /
      double(geometry.rim_wall.size());
  for (Vec2& st : geometry.rim_skin) st = geometry.centre + share * (st - geometry.centre);
  for (Vec2& st : geometry.rim_wall) st = wall + share * (st - wall);
  return geometry;
}

HexMesh breast_mesh(int order, double muscle) {
  HexMesh mesh = body_mesh(narrower_breast(), {.size = dome_near(8), .order = order});
  set_membrane_skin(1.45, mesh);
  if (muscle > 0) add_muscle_layer(muscle, mesh);
  return mesh;
}

bool same(const std::vector<Face>& a, const std::vector<Face>& b) {
  const auto key = [](const Face& f) { return 6 * f.element + f.local; };
  std::vector<int> one, other;
  std::transform(a.begin(), a.end(), std::back_inserter(one), key);
  std::transform(b.begin(), b.end(), std::back_inserter(other), key);
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  return one == other;
}

class SurroundingsOf : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(SurroundingsOf, SurroundTheBreastAndLeaveItAsItIs) {
  const auto [order, muscle] = GetParam();
  const HexMesh before = breast_mesh(order, muscle);
  HexMesh mesh = before;
  const Surroundings around = add_surroundings(16, mesh);
  EXPECT_EQ(around.part, 1);
  EXPECT_GT(around.mean_mm, 10);
  EXPECT_LE(around.mean_mm, 16);
  EXPECT_EQ(mesh.elements(), before.elements() + around.layers * int(before.cut_faces.size()));
  expect_faces_cover_boundary(mesh);
  EXPECT_GT(mesh_quality(mesh, mesh.points).min_scaled_jacobian, 0.15);
  EXPECT_EQ(mesh.skin_thickness.size(), mesh.skin_faces.size());
  for (int e = 0; e < mesh.elements(); ++e)
    EXPECT_EQ(is_around_breast(mesh, e), e >= before.elements());
  // What is in front of the muscle is still the breast's own wall.
  EXPECT_EQ(nodes_of(mesh, muscle_front(mesh)), nodes_of(before, muscle_front(before)));
  EXPECT_NEAR(muscle_thickness(mesh), muscle_thickness(before), 1e-9);
}

TEST_P(SurroundingsOf, LeftOutGiveTheSameMesh) {
  const auto [order, muscle] = GetParam();
  const HexMesh before = breast_mesh(order, muscle);
  HexMesh mesh = before;
  add_surroundings(16, mesh);
  const HexMesh alone = restricted(mesh, breast_elements);
  EXPECT_TRUE(have_same_breast(mesh, alone));
  EXPECT_TRUE(have_same_breast(alone, mesh));
  EXPECT_FALSE(have_same_breast(mesh, breast_mesh(order, muscle > 0 ? 0 : 8)));
  EXPECT_EQ(alone.connectivity, before.connectivity);
  EXPECT_EQ(alone.imaged, before.imaged);
  EXPECT_EQ(alone.points, before.points);
  EXPECT_EQ(alone.tissue, before.tissue);
  EXPECT_EQ(alone.skin_thickness, before.skin_thickness);
  EXPECT_TRUE(same(alone.skin_faces, before.skin_faces));
  EXPECT_TRUE(same(alone.pectoral_faces, before.pectoral_faces));
  EXPECT_TRUE(same(alone.cut_faces, before.cut_faces));
}

INSTANTIATE_TEST_SUITE_P(Orders, SurroundingsOf,
                         testing::Combine(testing::Values(1, 2), testing::Values(0.0, 8.0)));

TEST(Surroundings, FollowTheChestWall) {
  HexMesh mesh = breast_mesh(1, 0);
  const int first = mesh.nodes();
  add_surroundings(16, mesh);
  const ThoraxSurface& wall = *mesh.geometry->thorax;
  double farthest = 0;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    if (node < first) continue;
    const std::optional<Level> level = wall.at(mesh.imaged[std::size_t(node)]);
    ASSERT_TRUE(level.has_value());
    farthest = std::max(farthest, std::abs(level->value / level->gradient.norm()));
  }
  EXPECT_LT(farthest, 2);
}

// A rim of the skin that runs against that of the wall.
TEST(Surroundings, ThatWouldFoldAreNotMeshed) {
  HexMesh mesh = breast_mesh(1, 0);
  std::vector<Vec2>& rim = mesh.geometry->rim_skin;
  std::rotate(rim.begin(), rim.begin() + std::ptrdiff_t(rim.size() / 2), rim.end());
  const std::vector<int> before = mesh.connectivity;
  EXPECT_EQ(add_surroundings(16, mesh).layers, 0);
  EXPECT_EQ(mesh.connectivity, before);
  EXPECT_EQ(mesh.cut_faces.size(), breast_mesh(1, 0).cut_faces.size());
}

TEST(Surroundings, MayComeFirst) {
  HexMesh mesh = breast_mesh(1, 0);
  mesh.skin_thickness.assign(mesh.skin_faces.size(), 1.5);
  add_surroundings(16, mesh);
  mesh.reference = mesh.points;
  const HexMesh other = fixtures::renumbered(mesh).mesh;
  const HexMesh alone = restricted(other, breast_elements);
  EXPECT_EQ(alone.nodes(), restricted(mesh, breast_elements).nodes());
  EXPECT_EQ(std::count(alone.tissue.begin(), alone.tissue.end(), Tissue::other), 0);
  EXPECT_NEAR(mesh_volume(alone, alone.imaged),
              mesh_volume(restricted(mesh, breast_elements), mesh.imaged), 1e-6);
  EXPECT_TRUE(have_same_breast(other, alone));
  EXPECT_FALSE(have_same_breast(mesh, alone));
  expect_faces_cover_boundary(alone);
}

TEST(Surroundings, WithoutABreastAreRefused) {
  HexMesh mesh = breast_mesh(1, 0);
  mesh.tissue.assign(mesh.tissue.size(), Tissue::other);
  EXPECT_THROW(restricted(mesh, breast_elements), Error);
}

TEST(Surroundings, AMeshWithoutThemIsItsOwnBreast) {
  const HexMesh mesh = breast_mesh(1, 8);
  EXPECT_EQ(restricted(mesh, breast_elements).connectivity, mesh.connectivity);
}

}  // namespace
}  // namespace breast
