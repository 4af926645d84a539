// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "mesh/shape.hpp"

namespace breast {

namespace {

constexpr int samples_an_edge = 5;

std::vector<QuadShape> sample_shapes(int order) {
  std::vector<QuadShape> shapes;
  for (int j = 0; j < samples_an_edge; ++j) {
    for (int i = 0; i < samples_an_edge; ++i) {
      shapes.push_back(quad_shape(
          order, {2.0 * i / (samples_an_edge - 1) - 1, 2.0 * j / (samples_an_edge - 1) - 1}));
    }
  }
  return shapes;
}

bool held_fast(const Constraints& held, int node) {
  return held.held(node, 0) && held.held(node, 1) && held.held(node, 2);
}

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

std::vector<Face> free_boundary_faces(const HexTopology& mesh, const Constraints& held) {
  std::vector<Face> free;
  for (const auto* faces : {&mesh.skin_faces, &mesh.cut_faces, &mesh.pectoral_faces}) {
    for (const Face& face : *faces) {
      const std::vector<int> nodes = face_nodes(mesh, face);
      const bool moves =
          std::any_of(nodes.begin(), nodes.end(), [&](int n) { return !held_fast(held, n); });
      if (moves) free.push_back(face);
    }
  }
  return free;
}

std::vector<Face> touchable_faces(const HexTopology& mesh) {
  std::vector<Face> faces = mesh.skin_faces;
  faces.insert(faces.end(), mesh.cut_faces.begin(), mesh.cut_faces.end());
  return faces;
}

FacePoint face_point(const std::vector<int>& nodes, const std::vector<Vec3>& x,
                     const QuadShape& shape) {
  FacePoint point;
  Vec3 a1 = Vec3::Zero(), a2 = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3& node = x[std::size_t(nodes[k])];
    point.at += shape.values[Eigen::Index(k)] * node;
    a1 += shape.gradients(0, Eigen::Index(k)) * node;
    a2 += shape.gradients(1, Eigen::Index(k)) * node;
  }
  point.area = a1.cross(a2);
  return point;
}

double touching_area(const HexTopology& mesh, const std::vector<Face>& faces,
                     const Eigen::VectorXd& x, const Plate& plate) {
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

double deepest_penetration(const HexTopology& mesh, const std::vector<Face>& faces,
                           const Eigen::VectorXd& x, const Plate& plate) {
  const std::vector<QuadShape> shapes = sample_shapes(mesh.order);
  double deepest = 0;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const QuadShape& shape : shapes) {
      Vec3 point = Vec3::Zero();
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        point += shape.values[Eigen::Index(a)] * x.segment<3>(3L * nodes[a]);
      }
      deepest = std::max(deepest, -plate.gap(point).value);
    }
  }
  return deepest;
}

double thickness_at(const HexTopology& mesh, const Eigen::VectorXd& x, const Plate& plate,
                    double a) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (int c = 0; c < 4; ++c) {
      const Vec3 here = x.segment<3>(3 * nodes[std::size_t(c)]);
      const Vec3 next = x.segment<3>(3 * nodes[std::size_t((c + 1) % 4)]);
      const double p = here.dot(plate.anterior) - a, q = next.dot(plate.anterior) - a;
      if ((p < 0) == (q < 0)) continue;
      const double h = (here + p / (p - q) * (next - here)).dot(plate.n);
      low = std::min(low, h);
      high = std::max(high, h);
    }
  }
  return low <= high ? high - low : 0;
}

}  // namespace breast
