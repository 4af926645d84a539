// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/compressed_shape.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "contact/faces.hpp"
#include "core/units.hpp"
#include "mechanics/deformation.hpp"
#include "mesh/gauss.hpp"
#include "mesh/locate.hpp"
#include "mesh/muscle_front.hpp"
#include "mesh/nodal.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

double percent(double part, double whole) {
  return 100 * part / whole;
}

/// The fibroglandular fraction of an element of fat or fibroglandular tissue.
double gland_of(const HexTopology& mesh, int element) {
  const auto e = static_cast<std::size_t>(element);
  if (!mesh.fibroglandular_fraction.empty()) return double(mesh.fibroglandular_fraction[e]);
  return mesh.tissue[e] == Tissue::fibroglandular ? 1 : 0;
}

/// Parts of the body closer than this in front of a face count as touching it, mm: ten times the
/// accuracy of the plates.
constexpr double self_touching_mm = 0.5;

double depth_in_thorax(const HexMesh& mesh, const Vec3& at) {
  if (!mesh.geometry || !mesh.geometry->thorax) return 0;
  const std::optional<Level> level = mesh.geometry->thorax->at(at);
  return level ? std::max(0.0, -level->value / level->gradient.norm()) : 0;
}

std::vector<HexShape> gauss_shapes(int order) {
  std::vector<HexShape> shapes;
  for (const auto& point : gauss_cube(order + 1)) shapes.push_back(hex_shape(order, point.at));
  return shapes;
}

}  // namespace

Coverage coverage(const HexTopology& mesh, const Eigen::VectorXd& x, const Plate& plate) {
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
      if (!(plate.in_front(place) >= 0)) continue;
      seen += volume;
      gland_seen += glandular * volume;
    }
  }
  Coverage out;
  if (all > 0) out.volume = percent(seen, all);
  if (gland > 0) out.fibroglandular = percent(gland_seen, gland);
  return out;
}

double projected_cm2(const HexTopology& mesh, const std::vector<Vec3>& x, const Plate& plate) {
  double both_sides = 0;
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const auto& [local, weight] : gauss_square(3)) {
      const FacePoint point = face_point(nodes, x, quad_shape(mesh.order, local));
      if (!(plate.in_front(point.at) >= 0)) continue;
      both_sides += weight * std::abs(point.area.dot(plate.n));
    }
  }
  return 0.5 * both_sides / mm2_per_cm2;
}

std::optional<double> muscle_in_front(const HexTopology& mesh, const std::vector<Vec3>& x,
                                      const Plate& plate, const Vec3& at) {
  std::optional<double> most;
  if (std::ranges::find(mesh.tissue, Tissue::muscle) == mesh.tissue.end()) return most;
  const double row = at.dot(plate.lateral);
  for (const Face& face : muscle_front(mesh)) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec3 &here = x[std::size_t(nodes[c])], &next = x[std::size_t(nodes[(c + 1) % 4])];
      const double a = here.dot(plate.lateral) - row, b = next.dot(plate.lateral) - row;
      if ((a < 0) == (b < 0)) continue;
      const double in_front = plate.in_front(here + a / (a - b) * (next - here));
      most = std::max(in_front, most.value_or(in_front));
    }
  }
  return most;
}

SelfContact self_contact(const HexMesh& mesh, const std::vector<Vec3>& x) {
  const Locator body(mesh, x);
  SelfContact found;
  for (const Face& face : touchable_faces(mesh)) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const auto& [local, weight] : gauss_square(2)) {
      const FacePoint point = face_point(nodes, x, quad_shape(mesh.order, local));
      if (body.find(point.at + self_touching_mm * point.area.normalized())) {
        found.itself_cm2 += weight * point.area.norm() / mm2_per_cm2;
      }
      found.into_thorax_mm = std::max(found.into_thorax_mm, depth_in_thorax(mesh, point.at));
    }
  }
  return found;
}

std::map<Tissue, StrainRange> strain_ranges(const HexMesh& mesh, const std::vector<Vec3>& x) {
  const std::vector<HexShape> shapes = gauss_shapes(mesh.order);
  std::map<Tissue, StrainRange> ranges;
  for (int e = 0; e < mesh.elements(); ++e) {
    StrainRange& range = ranges[mesh.tissue[std::size_t(e)]];
    for (const HexShape& shape : shapes) {
      const Mat3 F = deformation_gradient(mesh, e, shape, mesh.reference, x);
      const Vec3 squares =
          Eigen::SelfAdjointEigenSolver<Mat3>(F.transpose() * F, Eigen::EigenvaluesOnly)
              .eigenvalues();
      const double det = F.determinant();
      range.min_stretch = std::min(range.min_stretch, std::sqrt(std::max(0.0, squares[0])));
      range.max_stretch = std::max(range.max_stretch, std::sqrt(squares[2]));
      range.min_det_F = std::min(range.min_det_F, det);
      range.max_det_F = std::max(range.max_det_F, det);
    }
  }
  return ranges;
}

std::vector<double> smallest_det_F(const HexMesh& mesh, const Eigen::VectorXd& x) {
  std::vector<HexShape> shapes = gauss_shapes(mesh.order);
  for (int corner = 0; corner < 8; ++corner) {
    shapes.push_back(hex_shape(mesh.order, hex_node_local(mesh.order, corner)));
  }
  const std::vector<Vec3> points = unflatten(x);
  std::vector<double> smallest(std::size_t(mesh.elements()));
  for (int e = 0; e < mesh.elements(); ++e) {
    double least = 1e30;
    for (const HexShape& shape : shapes) {
      least = std::min(least,
                       deformation_gradient(mesh, e, shape, mesh.reference, points).determinant());
    }
    smallest[std::size_t(e)] = least;
  }
  return smallest;
}

}  // namespace breast
