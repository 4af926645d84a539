// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/coverage.hpp"

#include <Eigen/LU>
#include <cmath>

#include "contact/face_point.hpp"
#include "core/units.hpp"
#include "mesh/gauss.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

double percent(double part, double whole) {
  return 100 * part / whole;
}

/// The fibroglandular fraction of an element of fat or fibroglandular tissue.
double gland_of(const HexMesh& mesh, int element) {
  const auto e = static_cast<std::size_t>(element);
  if (!mesh.fibroglandular_fraction.empty()) return double(mesh.fibroglandular_fraction[e]);
  return mesh.tissue[e] == Tissue::fibroglandular ? 1 : 0;
}

}  // namespace

Coverage coverage(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate) {
  struct Point {
    HexShape shape;
    double weight;
  };
  std::vector<Point> points;
  for (const auto& [at, weight] : gauss_cube(2))
    points.push_back({hex_shape(mesh.order, at), weight});
  double all = 0, seen = 0, gland = 0, gland_seen = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[static_cast<std::size_t>(e)] == Tissue::muscle) continue;
    const double glandular = gland_of(mesh, e);
    for (const Point& point : points) {
      Vec3 place = Vec3::Zero();
      Mat3 jacobian = Mat3::Zero();
      for (int a = 0; a < mesh.nodes_per_element(); ++a) {
        const Vec3 node = x.segment<3>(3L * mesh.element(e)[a]);
        place += point.shape.values[a] * node;
        jacobian += node * point.shape.gradients.col(a).transpose();
      }
      const double volume = point.weight * jacobian.determinant();
      all += volume;
      gland += glandular * volume;
      if (!(place.dot(plate.anterior) >= plate.edge_start)) continue;
      seen += volume;
      gland_seen += glandular * volume;
    }
  }
  Coverage out;
  if (all > 0) out.volume = percent(seen, all);
  if (gland > 0) out.fibroglandular = percent(gland_seen, gland);
  return out;
}

double projected_cm2(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate) {
  double both_sides = 0;
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const auto& [local, weight] : gauss_square(3)) {
      const FacePoint point = face_point(nodes, x, quad_shape(mesh.order, local));
      if (!(point.at.dot(plate.anterior) >= plate.edge_start)) continue;
      both_sides += weight * std::abs(point.area.dot(plate.n));
    }
  }
  return 0.5 * both_sides / mm2_per_cm2;
}

}  // namespace breast
