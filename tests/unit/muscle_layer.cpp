// SPDX-License-Identifier: GPL-3.0-or-later
// The layer of muscle behind the breast: its elements, the surface of the ribs, its thickness in labels,
// its place in plates, coverage and image.
#include "meshing/layers/muscle_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/compressed_shape.hpp"
#include "contact/plates.hpp"
#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/boundary_sets.hpp"
#include "mesh/muscle_front.hpp"
#include "mesh/nodal.hpp"
#include "mesh/quality.hpp"
#include "mesh/view_pose.hpp"
#include "meshing/body_mesh.hpp"
#include "surface/thorax.hpp"

namespace breast {
namespace {

HexMesh breast_mesh(int order = 1) {
  return body_mesh(analytic_breast(), {.size = dome_near(8), .order = order});
}

TEST(MuscleLayer, CoversTheBoundaryAndKeepsTheBreast) {
  for (const int order : {1, 2}) {
    const HexMesh before = breast_mesh(order);
    HexMesh mesh = before;
    add_muscle_layer(9, mesh);
    EXPECT_EQ(mesh.elements(), before.elements() + int(before.pectoral_faces.size()));
    EXPECT_EQ(mesh.pectoral_faces.size(), before.pectoral_faces.size());
    expect_faces_cover_boundary(mesh);
    for (int n = 0; n < before.nodes(); ++n) EXPECT_EQ(mesh.imaged[n], before.imaged[n]);
    EXPECT_GT(mesh_quality(mesh, mesh.points).min_scaled_jacobian, 0.2);
    EXPECT_NEAR(muscle_thickness(mesh), 9, 0.5);
    EXPECT_EQ(nodes_of(mesh, muscle_front(mesh)), nodes_of(before, before.pectoral_faces));
    EXPECT_EQ(muscle_thickness(before), 0);
  }
}

// On the analytic breast the wall is a cylinder, and so are the ribs behind it.
TEST(MuscleLayer, LiesOnTheSurfaceOfTheRibs) {
  HexMesh mesh = breast_mesh();
  const ThoraxSurface wall = *mesh.geometry->thorax;
  add_muscle_layer(9, mesh);
  const ThoraxSurface& ribs = *mesh.geometry->thorax;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    const double on_wall = wall.at(mesh.imaged[node])->value,
                 on_ribs = ribs.at(mesh.imaged[node])->value;
    EXPECT_NEAR(on_wall, on_ribs - 9, 1e-9);
    EXPECT_LT(std::abs(on_ribs), 0.5);  // the sheet's own distance from the wall's surface
  }
}

// R = 100 + 10 sin(2θ) + 0.1 z: the surface behind it is as far away as the normal says.
TEST(MuscleLayer, TheRibsFollowAWallThatBends) {
  ThoraxSurface wall;
  wall.angle_low = -1.5, wall.angle_high = 1.5, wall.height_low = -200, wall.height_high = 200;
  wall.angles = wall.heights = 40;
  for (int j = -1; j < 42; ++j) {
    for (int i = -1; i < 42; ++i)
      wall.coefficients.push_back(100 + 10 * std::sin(2 * (-1.5 + i * 3.0 / 40)) +
                                  0.1 * (j * 10 - 200));
  }
  const ThoraxSurface ribs = surface_behind(wall, 8);
  for (double angle = -1.2; angle <= 1.2; angle += 0.3) {
    const Level level = *ribs.at(wall.point(angle, 20));
    EXPECT_NEAR(level.value / level.gradient.norm(), 8, 0.1) << angle;
  }
}

TEST(MuscleLayer, IsMeasuredWhereTheLabelsShowItsBack) {
  const HexMesh mesh = breast_mesh();
  LabelVolume labels;
  labels.side = mesh.side;
  labels.grid.size = {150, 150, 150};
  labels.grid.spacing = Vec3(2, 2, 2);
  labels.grid.origin = Vec3(-150, -150, -150);
  labels.tissue.assign(labels.grid.voxels(), std::uint8_t(Tissue::muscle));
  EXPECT_FALSE(measured_muscle_thickness(labels, mesh).seen);
  EXPECT_EQ(measured_muscle_thickness(labels, mesh).mm, usual_muscle_mm);
  const ThoraxSurface& wall = *mesh.geometry->thorax;
  for (int k = 0; k < 150; ++k)
    for (int j = 0; j < 150; ++j)
      for (int i = 0; i < 150; ++i) {
        const auto level = wall.at(labels.grid.to_patient(Vec3(i, j, k)));
        if (level && level->value < -13)
          labels.tissue[labels.grid.offset(i, j, k)] = std::uint8_t(Tissue::other);
      }
  const MuscleThickness found = measured_muscle_thickness(labels, mesh);
  EXPECT_TRUE(found.seen);
  EXPECT_NEAR(found.mm, 13, 1.1);  // half a voxel
}

TEST(MuscleLayer, PlatesAndCoverageCountFromItsFront) {
  const HexMesh bare = breast_mesh();
  HexMesh mesh = bare;
  add_muscle_layer(9, mesh);
  PlateOptions options;
  options.image_edge = 5;
  HexMesh bare_at_rest = bare;
  for (HexMesh* body : {&mesh, &bare_at_rest}) body->reference = body->points;
  const ViewPose pose = view_pose(mesh.side, 0, 0);
  const PlatePair with = place_plates(mesh, mesh.points, pose, options),
                  without = place_plates(bare_at_rest, bare.points, pose, options);
  EXPECT_EQ(with.paddle.edge_start, without.paddle.edge_start);
  EXPECT_NEAR(coverage(mesh, flatten(mesh.points), with.paddle).volume,
              coverage(bare, flatten(bare.points), without.paddle).volume, 1e-9);
}

TEST(MuscleLayer, BadThicknessesAreRefused) {
  for (const char* text : {"", "thick", "-1", "31", "nan"})
    EXPECT_THROW(parse_muscle_thickness(text), Error) << text;
  HexMesh mesh = breast_mesh();
  EXPECT_THROW(add_muscle_layer(300, mesh), Error);
}

}  // namespace
}  // namespace breast
