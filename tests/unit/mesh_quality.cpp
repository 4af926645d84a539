// Scaled Jacobian, determinants and volumes against values known by hand.
#include "mesh/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.hpp"

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
