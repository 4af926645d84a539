// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the nearest triangle with a tree of bounding boxes.
#pragma once

#include <array>
#include <vector>

#include "surface/box_tree.hpp"
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
  std::vector<std::array<Vec3, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace breast
