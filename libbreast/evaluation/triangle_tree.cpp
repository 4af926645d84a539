// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
  if (!triangles_.empty()) build(0, int(triangles_.size()));
}

int TriangleTree::build(int first, int count) {
  constexpr int leaf_size = 4;
  const int index = int(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, centres;
  for (int t = first; t < first + count; ++t) {
    const Triangle& triangle = triangles_[std::size_t(t)];
    box.extend(triangle.a).extend(triangle.b).extend(triangle.c);
    centres.extend(triangle.centre());
  }
  nodes_[std::size_t(index)].box = box;
  if (count <= leaf_size) {
    nodes_[std::size_t(index)].first = first;
    nodes_[std::size_t(index)].count = count;
    return index;
  }
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(
      triangles_.begin() + first, triangles_.begin() + first + half,
      triangles_.begin() + first + count,
      [axis](const Triangle& a, const Triangle& b) { return a.centre()[axis] < b.centre()[axis]; });
  const int left = build(first, half), right = build(first + half, count - half);
  nodes_[std::size_t(index)].left = left;
  nodes_[std::size_t(index)].right = right;
  return index;
}

void TriangleTree::search(int index, const Vec3& point, double& best) const {
  const Node& node = nodes_[std::size_t(index)];
  for (int t = node.first; t < node.first + node.count; ++t) {
    const Triangle& triangle = triangles_[std::size_t(t)];
    best = std::min(best, squared_distance(point, triangle.a, triangle.b, triangle.c));
  }
  if (node.left < 0) return;
  const double left = nodes_[std::size_t(node.left)].box.squaredExteriorDistance(point);
  const double right = nodes_[std::size_t(node.right)].box.squaredExteriorDistance(point);
  const bool left_first = left <= right;
  if (std::min(left, right) < best) search(left_first ? node.left : node.right, point, best);
  if (std::max(left, right) < best) search(left_first ? node.right : node.left, point, best);
}

double TriangleTree::distance(const Vec3& point) const {
  double best = std::numeric_limits<double>::infinity();
  if (!nodes_.empty()) search(0, point, best);
  return std::sqrt(best);
}

}  // namespace breast
