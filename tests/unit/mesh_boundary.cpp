// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of a mesh: closed, in parts, and curved onto the sheets.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <set>

#include "core/parallel.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/boundary_sets.hpp"
#include "mesh/quality.hpp"
#include "meshing/boundary_surface.hpp"

namespace breast {
namespace {

// Tests run beside one another: threads waiting for a busy core cost more than they bring.
class OneThread : public testing::Environment {
  void SetUp() override { set_threads(1); }
};
const auto* const one_thread = testing::AddGlobalTestEnvironment(new OneThread);

TEST(BodyMesh, BoundarySurfaceIsClosedAndHoldsTheVolume) {
  const HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  const TriMesh surface = boundary_surface(mesh);
  EXPECT_EQ(surface.triangles.size(), 2 * boundary_faces(mesh).size());
  Vec3 area = Vec3::Zero();
  double volume = 0;
  std::set<double> parts;
  for (const auto& t : surface.triangles) {
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    area += 0.5 * (b - a).cross(c - a);
    volume += a.dot(b.cross(c)) / 6;
    parts.insert(surface.point_data.at("part")[t[0]]);
  }
  EXPECT_LT(area.norm(), 1e-6);
  EXPECT_NEAR(volume / mesh_volume(mesh, mesh.points), 1, 0.01);
  EXPECT_EQ(parts, (std::set<double>{0, 1, 2}));
}

// Nodes between corners of a boundary set that stand farther than `off` mm from its surface.
int nodes_off(const BodyMap& body, Hull part, const HexMesh& mesh, const std::vector<Face>& faces,
              double off) {
  const std::vector<Vec2>& rim =
      part == Hull::skin ? mesh.geometry->rim_skin : mesh.geometry->rim_wall;
  const HermiteSheet& sheet = part == Hull::skin ? body.skin_sheet() : body.wall_sheet();
  Vec2 centre = Vec2::Zero();
  for (const Vec2& at : rim) centre += at / double(rim.size());
  int count = 0;
  for (const int node : nodes_of(mesh, faces)) {
    // A start on the sheet's lattice that is near: Gauss-Newton is local.
    Vec2 start = centre;
    for (int s = 0; s <= 900; ++s) {
      const Vec2 at(s % 31 / 30.0, s / 31 / 30.0);
      if ((sheet.position(at) - mesh.points[node]).norm() <
          (sheet.position(start) - mesh.points[node]).norm())
        start = at;
    }
    count +=
        (nearest_on_hull(body, part, start, mesh.points[node]).x - mesh.points[node]).norm() > off;
  }
  return count;
}

TEST(CurvedBoundary, NodesLieOnTheSheetsAndTheVolumeIsTheBodys) {
  const BreastGeometry geometry = analytic_breast();
  const BodyMap body(geometry);
  BodyMeshReport flat, curved;
  body_mesh(geometry, {.size = dome_near(8)}, &flat);
  const HexMesh mesh = body_mesh(geometry, {.size = dome_near(8), .order = 2}, &curved);
  EXPECT_EQ(mesh.order, 2);
  EXPECT_EQ(mesh.imaged, mesh.points);
  expect_faces_cover_boundary(mesh);
  EXPECT_GT(mesh_quality(mesh, mesh.points).min_det_bound, 0);
  EXPECT_GT(curved.smoothed_scaled_jacobian, 0.5);
  EXPECT_EQ(curved.curved.held_back, 0);
  EXPECT_GT(curved.curved.largest_bow, 0.5);
  EXPECT_EQ(nodes_off(body, Hull::skin, mesh, mesh.skin_faces, 1e-6), 0);
  EXPECT_EQ(nodes_off(body, Hull::wall, mesh, mesh.pectoral_faces, 1e-6), 0);
  EXPECT_LT(curved.skin_distance.mean_mm, 0.15 * flat.skin_distance.mean_mm);
  EXPECT_LT(curved.cut_distance.mean_mm, 0.15 * flat.cut_distance.mean_mm);
  EXPECT_LT(curved.skin_distance.max_mm, flat.skin_distance.max_mm);
  EXPECT_LT(std::abs(curved.mesh_volume / curved.body_volume - 1), 0.001);
}

TEST(CurvedBoundary, IsHeldBackWhereTheCuboidWouldFold) {
  BodyMeshReport report;
  const HexMesh mesh = body_mesh(analytic_breast(), {.size = cuboid_size(10), .order = 2}, &report);
  EXPECT_GT(report.curved.held_back, 0);
  EXPECT_LT(report.curved.held_back, report.curved.nodes / 2);
  EXPECT_GT(report.curved.largest_gap, 0);
  EXPECT_GT(mesh_quality(mesh, mesh.points).min_det_bound, 0);
}

TEST(CurvedBoundary, BothSidesOfALayerBowAlike) {
  const double thickness = 1.45;
  const HexMesh mesh =
      body_mesh(analytic_breast(), {.size = {6, 6, 3, 2}, .order = 2, .skin_layer = thickness});
  int faces = 0;
  for (const Face& face : mesh.skin_faces) {
    EXPECT_EQ(mesh.tissue[face.element], Tissue::skin);
    const Vec3 outer = element_position(mesh, mesh.points, face.element, Vec3(0, 0, 1));
    const Vec3 inner = element_position(mesh, mesh.points, face.element, Vec3(0, 0, -1));
    EXPECT_NEAR((outer - inner).norm(), thickness, 0.15);
    ++faces;
  }
  EXPECT_GT(faces, 100);
}

TEST(CurvedBoundary, SurfaceOfCurvedFacesHoldsTheVolume) {
  const HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(6), .order = 2});
  const TriMesh surface = boundary_surface(mesh);
  EXPECT_EQ(surface.triangles.size(), 8 * boundary_faces(mesh).size());
  double volume = 0;
  for (const auto& t : surface.triangles)
    volume += surface.points[t[0]].dot(surface.points[t[1]].cross(surface.points[t[2]])) / 6;
  EXPECT_NEAR(volume / mesh_volume(mesh, mesh.points), 1, 0.015);
}

}  // namespace
}  // namespace breast
