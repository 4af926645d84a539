// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/touching_area.hpp"

#include <Eigen/Geometry>

#include "mesh/gauss.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

constexpr int squares_an_edge = 8;

struct AreaPoint {
  QuadShape shape;
  double weight = 0;
};

/// The middles of equal squares, because often only a part of a face touches.
std::vector<AreaPoint> area_points(int order) {
  constexpr double side = 2.0 / squares_an_edge;
  std::vector<AreaPoint> points;
  for (int j = 0; j < squares_an_edge; ++j) {
    for (int i = 0; i < squares_an_edge; ++i) {
      points.push_back(
          {quad_shape(order, {(i + 0.5) * side - 1, (j + 0.5) * side - 1}), side * side});
    }
  }
  return points;
}

}  // namespace

double touching_area(const HexMesh& mesh, const std::vector<Face>& faces, const Eigen::VectorXd& x,
                     const Plate& plate) {
  const std::vector<AreaPoint> points = area_points(mesh.order);
  double area = 0;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const AreaPoint& point : points) {
      Vec3 at = Vec3::Zero(), along = Vec3::Zero(), across = Vec3::Zero();
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const Vec3 node = x.segment<3>(3L * nodes[a]);
        at += point.shape.values[Eigen::Index(a)] * node;
        along += point.shape.gradients(0, Eigen::Index(a)) * node;
        across += point.shape.gradients(1, Eigen::Index(a)) * node;
      }
      if (plate.gap(at).value < touching_mm) area += point.weight * along.cross(across).norm();
    }
  }
  return area;
}

}  // namespace breast
