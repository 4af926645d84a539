// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace breast {

namespace {
double squared_distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0 ? std::clamp(edge.dot(point - a) / length2, 0.0, 1.0) : 0.0;
  return (a + t * edge - point).squaredNorm();
}
}  // namespace

double squared_distance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double n2 = normal.squaredNorm();
  if (n2 > 0) {
    // The point is inside if the foot of the perpendicular lies on the inner side of every edge.
    const bool inside = (b - a).cross(point - a).dot(normal) >= 0 &&
                        (c - b).cross(point - b).dot(normal) >= 0 &&
                        (a - c).cross(point - c).dot(normal) >= 0;
    if (inside) return std::pow((point - a).dot(normal), 2) / n2;
  }
  return std::min({squared_distance_to_segment(point, a, b),
                   squared_distance_to_segment(point, b, c),
                   squared_distance_to_segment(point, c, a)});
}

TriangleTree::TriangleTree(const TriMesh& mesh) {
  const auto at = [&](int i) { return mesh.points[std::size_t(i)]; };
  for (const auto& t : mesh.triangles) triangles_.push_back({at(t[0]), at(t[1]), at(t[2])});
  if (mesh.triangles.empty()) {
    for (const Vec3& x : mesh.points) triangles_.push_back({x, x, x});
  }
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& [a, b, c] : triangles_) {
    boxes.push_back(Eigen::AlignedBox3d(a).extend(b).extend(c));
  }
  tree_ = BoxTree(std::move(boxes));
}

double TriangleTree::distance(const Vec3& point) const {
  return std::sqrt(tree_.nearest(point, [&](int item) {
    const auto& [a, b, c] = triangles_[std::size_t(item)];
    return squared_distance(point, a, b, c);
  }));
}

}  // namespace breast
