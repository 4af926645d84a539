// SPDX-License-Identifier: GPL-3.0-or-later
// How much of a breast lies in front of the edge of the image.
#include "contact/compressed_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/standing_block.hpp"
#include "mesh/nodal.hpp"

namespace breast {
namespace {

// 60 deep in six layers: an edge between layers leaves exact fractions.
TEST(Coverage, IsTheVolumeInFrontOfTheEdge) {
  HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  Plate plate = plate_facing(view_pose(Side::left, 0));
  const auto of_edge = [&](double edge) {
    plate.edge_start = edge;
    return coverage(mesh, flatten(mesh.points), plate);
  };
  EXPECT_NEAR(of_edge(20).volume, 100 * 40.0 / 60, 1e-9);
  EXPECT_FALSE(of_edge(20).fibroglandular);
  plate.edge_start = 20;
  EXPECT_NEAR(projected_cm2(mesh, mesh.points, plate), 50 * 40 / 100.0, 1e-9);
  EXPECT_NEAR(of_edge(-5).volume, 100, 1e-9);
  EXPECT_NEAR(of_edge(65).volume, 0, 1e-12);
  // Gland in the foremost layer only: all of it in front of an edge at 20, and half by fractions.
  for (int e = 0; e < mesh.elements(); ++e) {
    double front = 0;
    for (int a = 0; a < 8; ++a) front += -mesh.points[std::size_t(mesh.element(e)[a])].y() / 8;
    if (front > 50) mesh.tissue[std::size_t(e)] = Tissue::fibroglandular;
  }
  EXPECT_NEAR(of_edge(20).fibroglandular.value(), 100, 1e-9);
  EXPECT_NEAR(of_edge(60).fibroglandular.value(), 0, 1e-9);
  mesh.fibroglandular_fraction.assign(std::size_t(mesh.elements()), 0.25F);
  EXPECT_NEAR(of_edge(20).fibroglandular.value(), 100 * 40.0 / 60, 1e-9);
}

// The ribs lie at y = 0, and the muscle, 10 thick at one end of the rows and 20 at the other, in front of them.
TEST(MuscleInFront, IsThatOfTheRowOfTheImage) {
  HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = 15;
  EXPECT_FALSE(muscle_in_front(mesh, mesh.points, plate, mesh.points.front()));
  for (int e = 0; e < mesh.elements(); ++e) {
    double front = 0;
    for (int a = 0; a < 8; ++a) front += -mesh.points[std::size_t(mesh.element(e)[a])].y() / 8;
    if (front < 10) mesh.tissue[std::size_t(e)] = Tissue::muscle;
  }
  double low = 1e30, high = -1e30;
  for (const Vec3& x : mesh.points) low = std::min(low, x.x()), high = std::max(high, x.x());
  std::vector<Vec3> sheared = mesh.points;
  for (Vec3& x : sheared) x.y() -= 10 * (x.x() - low) / (high - low);
  for (const double part : {0.1, 0.37, 0.9}) {
    const Vec3 at(low + part * (high - low), -50, 0);
    EXPECT_NEAR(muscle_in_front(mesh, sheared, plate, at).value(), 10 + 10 * part - 15, 1e-9);
  }
  EXPECT_FALSE(muscle_in_front(mesh, sheared, plate, Vec3(high + 5, -50, 0)));
}

}  // namespace
}  // namespace breast
