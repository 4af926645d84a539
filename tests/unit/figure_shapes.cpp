// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes the figures draw, against shapes with formulas: contours, silhouettes, sections, the gland's
// surface, slices of a scan.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "figures/body_surfaces.hpp"
#include "figures/parts.hpp"
#include "figures/shapes/contour_lines.hpp"
#include "figures/shapes/gland_surface.hpp"
#include "figures/shapes/plane_section.hpp"
#include "figures/shapes/slice_view.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/squashed.hpp"

using namespace breast;

namespace {

Facets ball(double radius, int steps = 48) {
  Facets facets;
  for (int j = 0; j <= steps; ++j) {
    for (int i = 0; i <= steps; ++i) {
      const double polar = std::numbers::pi * j / steps, round = 2 * std::numbers::pi * i / steps;
      facets.points.push_back(radius * Vec3(std::sin(polar) * std::cos(round),
                                            std::sin(polar) * std::sin(round), std::cos(polar)));
    }
  }
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      const int at = j * (steps + 1) + i;
      facets.quads.push_back({at, at + 1, at + steps + 2, at + steps + 1});
    }
  }
  return facets;
}

/// Enclosed volume, positive when the facets' normals point outwards (divergence theorem).
double enclosed(const Facets& facets) {
  double sum = 0;
  for (const auto& q : facets.quads) {
    const auto& x = facets.points;
    sum += x[std::size_t(q[0])].dot(x[std::size_t(q[1])].cross(x[std::size_t(q[2])])) / 6;
    if (q[2] != q[3])
      sum += x[std::size_t(q[0])].dot(x[std::size_t(q[2])].cross(x[std::size_t(q[3])])) / 6;
  }
  return sum;
}

template <class Point>
double total_length(const std::vector<std::array<Point, 2>>& lines) {
  double sum = 0;
  for (const auto& [a, b] : lines) sum += (b - a).norm();
  return sum;
}

}  // namespace

TEST(FigureShapes, ContoursOfADistanceAreCircles) {
  PlaneField field(121, 101, 0.5);
  const Vec2 centre(31.3, 24.7);
  for (int row = 0; row < field.height; ++row) {
    for (int column = 0; column < field.width; ++column) {
      field.at(column, row) = float((0.5 * Vec2(column, row) - centre).norm());
    }
  }
  const auto lines = contour_lines(field, 20);
  for (const auto& line : lines) {
    for (const Vec2& p : line) EXPECT_NEAR((p - centre).norm(), 20, 0.01);
  }
  EXPECT_NEAR(total_length(lines), 2 * std::numbers::pi * 20, 0.1);
  EXPECT_TRUE(contour_lines(field, 1000).empty());
}

TEST(FigureShapes, SmoothingKeepsAStraightBorder) {
  PlaneField field(60, 40, 1);
  for (int row = 0; row < 40; ++row) {
    for (int column = 30; column < 60; ++column) field.at(column, row) = 1;
  }
  for (const auto& line : contour_lines(smoothed(field, 2), 0.5)) {
    for (const Vec2& p : line) EXPECT_NEAR(p.x(), 29.5, 1e-5);
  }
}

TEST(FigureShapes, ABallIsCutInACircleAndSeenAsOne) {
  const Facets facets = ball(40);
  const auto cut = plane_section(facets, Vec3::UnitZ(), 24);
  EXPECT_NEAR(total_length(cut), 2 * std::numbers::pi * 32, 1);
  for (const auto& line : cut) {
    for (const Vec3& p : line) EXPECT_NEAR(p.z(), 24, 1e-9);
  }
  const Vec3 direction = Vec3(1, 2, -0.5).normalized();
  const auto seen = silhouette(facets, direction, Vec3::UnitZ(), Vec3(1, 1, 1));
  ASSERT_GT(seen.size(), 50u);
  for (const auto& line : seen) {
    for (const Vec3& p : line) {
      EXPECT_NEAR((p - p.dot(direction) * direction).norm(), 40, 0.8);
      EXPECT_NEAR((p - Vec3(1, 1, 1)).dot(direction), 0, 1e-9);
    }
  }
}

// The fixture's gland is a ball of 20 mm about (0, 30, 0).
TEST(FigureShapes, TheGlandsSurfaceEnclosesItsVolumeInTheScan) {
  HexMesh mesh = fixtures::landmarked_breast(10);
  mesh.fibroglandular_fraction.clear();
  const Facets surface = gland_facets(mesh, mesh.imaged);
  ASSERT_FALSE(surface.quads.empty());
  const double volume = gland_volume(mesh);
  EXPECT_NEAR(enclosed(surface), volume, 0.06 * volume);
  ASSERT_EQ(surface.normals.size(), surface.points.size());
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    const Vec3 out = surface.points[n] - Vec3(0, 30, 0);
    EXPECT_NEAR(surface.normals[n].norm(), 1, 1e-9);
    EXPECT_GT(surface.normals[n].dot(out.normalized()), 0.3);
    EXPECT_NEAR(out.norm(), 20, 7);  // of elements of about 12 mm
  }
}

// The element map carries the surface: an affine deformation of the nodes is one of the surface.
TEST(FigureShapes, TheGlandsSurfaceFollowsTheElementMap) {
  const HexMesh mesh = fixtures::landmarked_breast(8);
  Mat3 gradient;
  gradient << 1.3, 0.2, 0, -0.1, 0.6, 0.1, 0, 0.3, 1.1;
  std::vector<Vec3> moved;
  for (const Vec3& x : mesh.imaged) moved.push_back(gradient * x + Vec3(3, -40, 7));
  const Facets before = gland_facets(mesh, mesh.imaged), after = gland_facets(mesh, moved);
  ASSERT_EQ(before.points.size(), after.points.size());
  ASSERT_EQ(before.quads.size(), after.quads.size());
  for (std::size_t n = 0; n < before.points.size(); ++n) {
    EXPECT_LT((gradient * before.points[n] + Vec3(3, -40, 7) - after.points[n]).norm(), 1e-9);
  }
}

TEST(FigureShapes, ABreastWithoutGlandHasNoSurface) {
  HexMesh mesh = fixtures::landmarked_breast(8);
  mesh.tissue.assign(mesh.tissue.size(), Tissue::fat);
  mesh.fibroglandular_fraction.clear();
  EXPECT_TRUE(gland_facets(mesh, mesh.imaged).quads.empty());
}

namespace {

/// Labels of a ball of fat of 40 mm with a ball of gland of 20 mm in it, on muscle behind y = 30.
LabelVolume ball_labels() {
  LabelVolume labels;
  labels.grid.spacing = Vec3(1, 1, 2);
  labels.grid.size = {101, 101, 51};
  labels.grid.origin = Vec3(-50, -50, -50);
  labels.tissue.assign(labels.grid.voxels(), std::uint8_t(Tissue::air));
  labels.fibroglandular_fraction.assign(labels.grid.voxels(), 0);
  labels.chest_wall_confidence.assign(labels.grid.voxels(), 1);
  for (int k = 0; k < 51; ++k) {
    for (int j = 0; j < 101; ++j) {
      for (int i = 0; i < 101; ++i) {
        const Vec3 x = labels.grid.to_patient(Vec3(i, j, k));
        const std::size_t at = labels.grid.offset(i, j, k);
        if (x.norm() < 40) labels.tissue[at] = std::uint8_t(Tissue::fat);
        if (x.norm() < 20) labels.tissue[at] = std::uint8_t(Tissue::fibroglandular);
        if (x.norm() < 20) labels.fibroglandular_fraction[at] = 1;
        if (x.y() > 30) labels.tissue[at] = std::uint8_t(Tissue::muscle);
      }
    }
  }
  return labels;
}

}  // namespace

TEST(FigureShapes, SlicesHaveTheirContoursWhereTheTissuesEnd) {
  const LabelVolume labels = ball_labels();
  for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::sagittal, SlicePlane::coronal}) {
    const SliceFrame frame(plane, Vec3(0.2, -0.3, 0.4), Vec2(96, 96));
    const SliceContours contours = slice_contours(labels, frame);
    ASSERT_GT(contours.skin.size(), 50u);
    ASSERT_GT(contours.gland.size(), 50u);
    for (const auto& line : contours.gland) {
      EXPECT_NEAR(frame.at(line[0]).norm(), 20, 1.2);
    }
    EXPECT_EQ(contours.wall.empty(), plane == SlicePlane::coronal);
    for (const auto& line : contours.wall) EXPECT_NEAR(frame.at(line[0]).y(), 30.5, 1.2);
    for (const auto& line : contours.skin) {
      const Vec3 x = frame.at(line[0]);
      // Beside the muscle, which is body too, the border of the body leaves the ball.
      if (x.y() >= 26) continue;
      EXPECT_NEAR(x.norm(), 40, 1.5) << x.transpose();
    }
  }
}

// Left is at the right of axial and coronal slices, anterior on top of axial and left of sagittal ones.
TEST(FigureShapes, SlicesShowTheirPointsWhereTheirLettersSay) {
  LabelVolume labels = ball_labels();
  Volume<float> scan(labels.grid, 0);
  const auto mark = [&](const Vec3& at) {
    const Vec3 index = labels.grid.to_index(at);
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        for (int k = -1; k <= 1; ++k) {
          scan.at(int(index.x()) + i, int(index.y()) + j, int(index.z()) + k) = 100;
        }
      }
    }
  };
  mark(Vec3(20, -24, 30));  // left, anterior, superior
  const auto bright = [&](SlicePlane plane) {
    const SliceFrame frame(plane, Vec3(20, -24, 30), Vec2(200, 200));
    const SliceImage image = slice_image(scan, frame, 0.5, 100);
    Vec2 sum = Vec2::Zero();
    double weight = 0;
    for (int row = 0; row < image.height; ++row) {
      for (int column = 0; column < image.width; ++column) {
        const double grey =
            image.grey[std::size_t(row) * std::size_t(image.width) + std::size_t(column)];
        sum += grey * Vec2(column, image.height - 1 - row);
        weight += grey;
      }
    }
    const Vec3 found = frame.at(0.5 * sum / weight);
    EXPECT_LT((found - Vec3(20, -24, 30)).norm(), 0.3);
    return frame;
  };
  const SliceFrame axial = bright(SlicePlane::axial), sagittal = bright(SlicePlane::sagittal),
                   coronal = bright(SlicePlane::coronal);
  EXPECT_GT(axial.flat(Vec3(40, 0, 0)).x(), axial.flat(Vec3(0, 0, 0)).x());
  EXPECT_GT(axial.flat(Vec3(0, -40, 0)).y(), axial.flat(Vec3(0, 0, 0)).y());
  EXPECT_LT(sagittal.flat(Vec3(0, -40, 0)).x(), sagittal.flat(Vec3(0, 0, 0)).x());
  EXPECT_GT(sagittal.flat(Vec3(0, 0, 40)).y(), sagittal.flat(Vec3(0, 0, 0)).y());
  EXPECT_GT(coronal.flat(Vec3(40, 0, 0)).x(), coronal.flat(Vec3(0, 0, 0)).x());
  EXPECT_GT(coronal.flat(Vec3(0, 0, 40)).y(), coronal.flat(Vec3(0, 0, 0)).y());
}

// A curve that leaves the image is cut at its border, and its caption says by how much.
TEST(FigureShapes, CurvesEndAtTheImagesBorder) {
  const Vec2 size(80, 150);
  double outside = -1;
  const auto whole = parts_inside({{10, 10}, {20, 90}, {70, 140}}, size, &outside);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].size(), 3u);
  EXPECT_NEAR(outside, 0, 1e-12);
  // In, out beyond u = 80, in again, and at last beyond v = 0.
  const auto parts =
      parts_inside({{60, 50}, {100, 50}, {100, 60}, {60, 60}, {60, -30}}, size, &outside);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(outside, 20 + 10 + 20 + 30, 1e-9);
  EXPECT_LT((parts[0].back() - Vec2(80, 50)).norm(), 1e-9);
  EXPECT_LT((parts[1].front() - Vec2(80, 60)).norm(), 1e-9);
  EXPECT_LT((parts[1].back() - Vec2(60, 0)).norm(), 1e-9);
  EXPECT_TRUE(parts_inside({{-5, 3}, {-5, 90}}, size, &outside).empty());
  EXPECT_NEAR(outside, 87, 1e-12);
}
