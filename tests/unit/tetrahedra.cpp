// SPDX-License-Identifier: GPL-3.0-or-later
// Tetrahedra of the analytic breast: filled, closed, in parts, with the hexahedra's tissue.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "mesh/quality.hpp"
#include "meshing/boundary_surface.hpp"
#include "meshing/tumour.hpp"
#include "tetrahedra/delaunay.hpp"
#include "tetrahedra/report.hpp"
#include "tetrahedra/tissue.hpp"

namespace breast {
namespace {

HexMesh hexahedra() {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  add_tumour(parse_tumour("5,45,3:14"), mesh);
  return mesh;
}

TEST(Tetrahedra, FillTheBodyAndKeepItsTissue) {
  const HexMesh hex = hexahedra();
  TetMesh mesh = delaunay_tetrahedra(boundary_surface(hex), 8);
  copy_tissue(hex, mesh);
  const TetQuality quality = tet_quality(mesh);
  EXPECT_GT(mesh.tetrahedra.size(), 1500u);
  EXPECT_GT(quality.least_volume, 0);
  EXPECT_GT(quality.least_dihedral, 2);
  const double volume = mesh_volume(hex, hex.points);
  EXPECT_NEAR(quality.volume / volume, 1, 0.01);
  double tumour = 0, hex_tumour = 0;
  const std::vector<double> volumes = element_volumes(hex, hex.points);
  for (int e = 0; e < hex.elements(); ++e)
    hex_tumour += hex.tissue[e] == Tissue::tumour ? volumes[e] : 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    tumour += mesh.tissue[t] == Tissue::tumour ? tetrahedron_volume(mesh, t) : 0;
  ASSERT_GT(hex_tumour, 0);
  EXPECT_NEAR(tumour / hex_tumour, 1, 0.15);
}

TEST(Tetrahedra, ConformAndHaveTheBoundaryInParts) {
  const HexMesh hex = hexahedra();
  const TetMesh mesh = delaunay_tetrahedra(boundary_surface(hex), 8);
  std::map<std::set<int>, int> uses;
  for (const auto& t : mesh.tetrahedra) {
    for (int c = 0; c < 4; ++c) {
      std::set<int> face(t.begin(), t.end());
      face.erase(t[c]);
      ++uses[face];
    }
  }
  std::size_t outer = 0;
  for (const auto& [face, count] : uses) {
    EXPECT_LE(count, 2);
    outer += count == 1;
  }
  ASSERT_EQ(outer, mesh.triangles.size());
  ASSERT_EQ(mesh.part.size(), mesh.triangles.size());
  double inside = 0;
  std::array<double, 3> area{}, hex_area{};
  const auto add = [](std::array<double, 3>& areas, int part, const Vec3& a, const Vec3& b,
                      const Vec3& c) { areas[part] += 0.5 * (b - a).cross(c - a).norm(); };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    EXPECT_EQ(uses.at(std::set<int>(t.begin(), t.end())), 1);
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    inside += a.dot(b.cross(c)) / 6;
    add(area, mesh.part[i], a, b, c);
  }
  EXPECT_NEAR(-inside / tet_quality(mesh).volume, 1, 1e-9);  // turned inwards, and closed
  const TriMesh surface = boundary_surface(hex);
  for (const auto& t : surface.triangles) {
    add(hex_area, int(surface.point_data.at("part")[t[0]]), surface.points[t[0]],
        surface.points[t[1]], surface.points[t[2]]);
  }
  for (int part = 0; part < 3; ++part) EXPECT_NEAR(area[part] / hex_area[part], 1, 0.03) << part;
}

TEST(Tetrahedra, SameFromTheSameSurface) {
  const TriMesh surface = boundary_surface(hexahedra());
  const TetMesh one = delaunay_tetrahedra(surface, 10), two = delaunay_tetrahedra(surface, 10);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.tetrahedra, two.tetrahedra);
}

TEST(Tetrahedra, OpenSurfaceAndBadEdgeAreRefused) {
  TriMesh surface = boundary_surface(hexahedra());
  EXPECT_THROW(delaunay_tetrahedra(surface, 0), Error);
  surface.triangles.pop_back();
  EXPECT_THROW(delaunay_tetrahedra(surface, 8), Error);
  surface.point_data.clear();
  EXPECT_THROW(delaunay_tetrahedra(surface, 8), Error);
}

}  // namespace
}  // namespace breast
