// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement fields against maps known in closed form, scans seen through them, and the scene that shows them.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

#include "core/error.hpp"
#include "export/slicer/field_check.hpp"
#include "export/slicer/scene.hpp"
#include "export/slicer/warp.hpp"
#include "fixtures/analytic_breast.hpp"
#include "meshing/body_mesh.hpp"

namespace breast {
namespace {

HexMesh body() {
  return body_mesh(analytic_breast(), {.size = dome_near(6)});
}

template <class Map>
std::vector<Vec3> mapped(const std::vector<Vec3>& points, const Map& map) {
  std::vector<Vec3> result;
  for (const Vec3& point : points) result.push_back(map(point));
  return result;
}

Vec3 affine(const Vec3& x) {
  Mat3 a;
  a << 1.1, 0.1, -0.05, 0.02, 0.8, 0.1, 0, -0.1, 1.2;
  return a * x + Vec3(4, -7, 12);
}

Grid oblique() {
  Grid grid;
  grid.spacing = Vec3(3, 2.5, 4);
  const double c = std::cos(0.2), s = std::sin(0.2);
  grid.direction << c, -s, 0, s, c, 0, 0, 0, 1;
  grid.origin = Vec3(0.3, 0.1, -0.2);
  return grid;
}

// A linear map stays linear in every element and between grid points, also in cells that the boundary crosses.
TEST(SlicerField, AffineMapIsExactUpToItsRounding) {
  HexMesh mesh = body();
  mesh.points = mapped(mesh.imaged, affine);
  const Grid grid = covering_grid(oblique(), {&mesh.imaged, &mesh.points}, 10, 0);
  const DisplacementField there = displacement_field(mesh, mesh.imaged, mesh.points, grid);
  const DisplacementField back = displacement_field(mesh, mesh.points, mesh.imaged, grid);
  constexpr double rounding_mm = 2e-4;
  const FieldCheck check = check_field(there, mesh, mesh.imaged, mesh.points);
  EXPECT_EQ(check.points, 1000);
  EXPECT_LT(check.max_mm, rounding_mm);
  EXPECT_EQ(check.beyond_percent, 0);
  EXPECT_LT(check_field(back, mesh, mesh.points, mesh.imaged).max_mm, rounding_mm);
  EXPECT_LT(check_round_trip(there, back, mesh, mesh.imaged).max_mm, 2 * rounding_mm);
  Mat3 a;
  a << 1.1, 0.1, -0.05, 0.02, 0.8, 0.1, 0, -0.1, 1.2;
  EXPECT_NEAR(check.smallest_det, a.determinant(), 2e-3);
}

// Halving the distance of grid points must bring a bent map nearer, and not leave it where it was.
TEST(SlicerField, FinerGridsComeNearer) {
  HexMesh mesh = body();
  mesh.points = mapped(mesh.imaged, [](const Vec3& x) {
    return Vec3(x + 6 * Vec3(std::sin(x.z() / 20), std::sin(x.x() / 25), std::cos(x.y() / 20)));
  });
  const auto error = [&](double spacing) {
    const Grid grid = covering_grid(Grid(), {&mesh.imaged, &mesh.points}, 5, spacing);
    return check_field(displacement_field(mesh, mesh.imaged, mesh.points, grid), mesh, mesh.imaged,
                       mesh.points);
  };
  const FieldCheck coarse = error(6), fine = error(3);
  EXPECT_GT(coarse.mean_mm, 1e-3);
  EXPECT_LT(fine.mean_mm, 0.5 * coarse.mean_mm);
  EXPECT_LT(fine.max_mm, coarse.max_mm);
  EXPECT_GT(fine.smallest_det, 0);
}

TEST(SlicerField, GridLiesOnTheLatticeAndCoversBothShapes) {
  HexMesh mesh = body();
  mesh.points = mapped(mesh.imaged, affine);
  const Grid lattice = oblique(),
             grid = covering_grid(lattice, {&mesh.imaged, &mesh.points}, 10, 0);
  const Vec3 first = lattice.to_index(grid.origin);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(first[d], std::round(first[d]), 1e-9);
  for (const auto* shape : {&mesh.imaged, &mesh.points}) {
    for (const Vec3& point : *shape) {
      const Vec3 index = grid.to_index(point);
      for (int d = 0; d < 3; ++d) {
        EXPECT_GE(index[d] * grid.spacing[d], 10 - 1e-9);
        EXPECT_LE(index[d] * grid.spacing[d], (grid.size[d] - 1) * grid.spacing[d] - 10 + 1e-9);
      }
    }
  }
  EXPECT_THROW(covering_grid(lattice, {&mesh.imaged}, 10, 1e-3), Error);
}

// The continuation invents nothing: its vectors stay within those of body and border, and are the same each time.
TEST(SlicerField, ContinuationStaysWithinWhatItContinues) {
  HexMesh mesh = body();
  mesh.points = mapped(mesh.imaged, affine);
  const Grid grid = covering_grid(oblique(), {&mesh.imaged}, 30, 0);
  const DisplacementField field = displacement_field(mesh, mesh.imaged, mesh.points, grid);
  for (std::size_t c = 0; c < 3; ++c) {
    float low = 1e9F, high = -1e9F;
    std::size_t outside = 0;
    for (std::size_t n = 0; n < field.part.size(); ++n) {
      if (field.part[n] == FieldPart::continued) continue;
      low = std::min(low, field.vectors[n][c]);
      high = std::max(high, field.vectors[n][c]);
    }
    for (std::size_t n = 0; n < field.part.size(); ++n) {
      if (field.part[n] != FieldPart::continued) continue;
      ++outside;
      EXPECT_GE(field.vectors[n][c], low - 1e-3F);
      EXPECT_LE(field.vectors[n][c], high + 1e-3F);
    }
    EXPECT_GT(outside, 1000u);
  }
  EXPECT_EQ(displacement_field(mesh, mesh.imaged, mesh.points, grid).vectors, field.vectors);
}

TEST(SlicerField, BodyBetweenGridPointsIsRefused) {
  const HexMesh mesh = body();
  Grid far;
  far.size = {2, 2, 2};
  far.origin = Vec3(1e4, 0, 0);
  EXPECT_THROW(displacement_field(mesh, mesh.imaged, mesh.imaged, far), Error);
}

TEST(SlicerWarp, LinearImageIsSeenWhereTheMapTakesIt) {
  HexMesh mesh = body();
  mesh.points = mapped(mesh.imaged, affine);
  const Vec3 slope(0.5, -1, 2);
  Volume<float> scan(covering_grid(oblique(), {&mesh.imaged}, 20, 0));
  const auto& size = scan.grid.size;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i)
        scan.at(i, j, k) = float(1000 + slope.dot(scan.grid.to_patient(Vec3(i, j, k))));
    }
  }
  const Grid grid = covering_grid(oblique(), {&mesh.points}, 10, 0);
  const DisplacementField back = displacement_field(mesh, mesh.points, mesh.imaged, grid);
  const Volume<float> seen = warped(scan, back, -1);
  std::size_t inside = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t at = grid.offset(i, j, k);
        if (back.part[at] != FieldPart::body) {
          EXPECT_EQ(seen.voxels[at], -1);
          continue;
        }
        ++inside;
        const Vec3 origin = back.moved(grid.to_patient(Vec3(i, j, k)));
        EXPECT_LT((affine(origin) - grid.to_patient(Vec3(i, j, k))).norm(), 1e-3);
        EXPECT_NEAR(seen.voxels[at], 1000 + slope.dot(origin), 1e-2);
      }
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_EQ(part_volume(back).voxels[0], std::uint8_t(back.part[0]));
}

TEST(SlicerScene, NodesAreUniqueAndRefersToWhatIsThere) {
  const std::string xml = scene_xml({{SceneKind::volume, "scan", "scan.nrrd", true},
                                     {SceneKind::volume, "warped", "warped.nrrd"},
                                     {SceneKind::segmentation, "labels", "labels.seg.nrrd", true},
                                     {SceneKind::model, "a <b> & \"c\"", "m.vtp"},
                                     {SceneKind::transform, "t", "t.nrrd"},
                                     {SceneKind::points, "p", "p.mrk.json"},
                                     {SceneKind::curve, "c", "c.mrk.json"}});
  EXPECT_NE(xml.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
  std::set<std::string> ids;
  const std::regex id(" id=\"([^\"]*)\"");
  for (std::sregex_iterator found(xml.begin(), xml.end(), id), end; found != end; ++found)
    EXPECT_TRUE(ids.insert((*found)[1]).second) << (*found)[1];
  EXPECT_EQ(ids.size(), 7u * 3 + 3);
  const std::regex reference("(?:display:|storage:|VolumeID=\")(vtkMRML[A-Za-z0-9]*)");
  int references = 0;
  for (std::sregex_iterator found(xml.begin(), xml.end(), reference), end; found != end; ++found) {
    EXPECT_TRUE(ids.count((*found)[1])) << (*found)[1];
    ++references;
  }
  EXPECT_EQ(references, 7 * 2 + 3 * 2);
}

}  // namespace
}  // namespace breast
