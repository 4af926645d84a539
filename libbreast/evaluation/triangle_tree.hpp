// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the nearest triangle with a tree of bounding boxes.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "surface/tri_mesh.hpp"

namespace breast {

/// Squared distance in mm² from a point to a triangle (which may be degenerate).
double squared_distance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

class TriangleTree {
 public:
  /// Builds the tree; a mesh without triangles is searched by its points. Keeps no reference to the
  /// mesh.
  explicit TriangleTree(const TriMesh& mesh);
  /// Distance to the nearest triangle, mm.
  double distance(const Vec3& point) const;

 private:
  struct Triangle {
    Vec3 a, b, c;
    Vec3 centre() const { return (a + b + c) / 3; }
  };
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  ///< leaf: triangles; inner node: count 0
    int left = -1, right = -1;
  };
  int build(int first, int count);
  void search(int node, const Vec3& point, double& best) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace breast
