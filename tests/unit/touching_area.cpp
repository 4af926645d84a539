// SPDX-License-Identifier: GPL-3.0-or-later
// The area of faces that touch a plate, where it is known: flat, tilted, deeper than the plate, away from it.
#include "contact/faces.hpp"

#include <gtest/gtest.h>

#include "fixtures/standing_block.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/view_pose.hpp"

namespace breast {
namespace {

constexpr double size = 20;  // mm

Plate plate_on_top() {
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.level = -size;
  plate.edge_start = -1e3;
  plate.far_edge = plate.half_width = 1e3;
  return plate;
}

/// Area that touches when the corners of the top face are so far below the plate at its two ends, mm.
double touching(double anterior_gap, double posterior_gap, int elements) {
  const HexMesh mesh = fixtures::standing_block({size, size, size}, {elements, elements, 1});
  Eigen::VectorXd x(3L * mesh.nodes());
  double front = 1e9, back = -1e9;
  for (const Vec3& point : mesh.reference) {
    front = std::min(front, point.y());
    back = std::max(back, point.y());
  }
  for (int n = 0; n < mesh.nodes(); ++n) {
    Vec3 point = mesh.reference[std::size_t(n)];
    const double part = (point.y() - front) / (back - front);
    if (point.z() > size - 1) point.z() -= anterior_gap + part * (posterior_gap - anterior_gap);
    x.segment<3>(3L * n) = point;
  }
  return touching_area(mesh, boundary_faces(mesh), x, plate_on_top());
}

TEST(TouchingArea, IsThatOfAFaceThatLiesOnThePlate) {
  EXPECT_NEAR(touching(0, 0, 1), size * size, 1e-9);
  EXPECT_NEAR(touching(0, 0, 3), size * size, 1e-9);
  EXPECT_NEAR(touching(-0.5, -0.5, 3), size * size, size);  // and a strip of the sides
  EXPECT_EQ(touching(1, 1, 3), 0);
}

TEST(TouchingArea, EndsWithinAFace) {
  EXPECT_NEAR(touching(0, 2 * touching_mm, 1), size * size / 2, 0.05);
  EXPECT_NEAR(touching(0, 4 * touching_mm, 2), size * size / 4, 0.05);
}

}  // namespace
}  // namespace breast
