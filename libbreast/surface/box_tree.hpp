// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of bounding boxes, in which what lies at or near a point is found without looking at everything.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Boxes in mm, split at the middle of the longest edge. The items are the indices of the boxes. All
/// queries are const and may be made from many threads.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes);

  int size() const { return int(boxes_.size()); }
  /// The box of all items; there must be one.
  const Eigen::AlignedBox3d& whole() const { return tree_[0].box; }
  /// Whether the item's box, widened by `slack` (mm), contains the point.
  bool holds(int item, const Vec3& point, double slack) const {
    return holds(boxes_[item], point, slack);
  }

  /// Calls `visit(item)` for every item whose box, widened by `slack` (mm), contains the point, until
  /// `visit` returns true.
  template <class Visit>
  void containing(const Vec3& point, double slack, Visit visit) const;

  /// Calls `squared_distance(item)` (mm²) for every item whose box is not farther than the least of the
  /// values so far, near items first. Returns the least value; infinite if there are no items.
  template <class SquaredDistance>
  double nearest(const Vec3& point, SquaredDistance squared_distance) const;

 private:
  struct Branch {
    Eigen::AlignedBox3d box;
    int left = -1, right = -1;  ///< children, or
    int first = 0, count = 0;   ///< a leaf's range of order_
  };
  static bool holds(const Eigen::AlignedBox3d& box, const Vec3& point, double slack) {
    return ((point - box.min()).array() >= -slack).all() &&
           ((box.max() - point).array() >= -slack).all();
  }
  int build(int first, int count);

  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<int> order_;
  std::vector<Branch> tree_;
};

template <class Visit>
void BoxTree::containing(const Vec3& point, double slack, Visit visit) const {
  if (tree_.empty()) return;
  std::array<int, 64> stack;  // a balanced tree of 2^31 items is 31 deep
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Branch& branch = tree_[stack[--depth]];
    if (!holds(branch.box, point, slack)) continue;
    if (branch.left >= 0) {
      stack[depth++] = branch.right;
      stack[depth++] = branch.left;
      continue;
    }
    for (int i = branch.first; i < branch.first + branch.count; ++i) {
      if (holds(boxes_[order_[i]], point, slack) && visit(order_[i])) return;
    }
  }
}

template <class SquaredDistance>
double BoxTree::nearest(const Vec3& point, SquaredDistance squared_distance) const {
  double best = std::numeric_limits<double>::infinity();
  if (tree_.empty()) return best;
  std::vector<std::pair<double, int>> stack{{tree_[0].box.squaredExteriorDistance(point), 0}};
  while (!stack.empty()) {
    const auto [distance, index] = stack.back();
    stack.pop_back();
    if (distance > best) continue;
    const Branch& branch = tree_[index];
    if (branch.left >= 0) {
      std::pair near{tree_[branch.left].box.squaredExteriorDistance(point), branch.left};
      std::pair far{tree_[branch.right].box.squaredExteriorDistance(point), branch.right};
      if (far.first < near.first) std::swap(near, far);
      stack.push_back(far);
      stack.push_back(near);
      continue;
    }
    for (int i = branch.first; i < branch.first + branch.count; ++i) {
      if (boxes_[order_[i]].squaredExteriorDistance(point) > best) continue;
      best = std::min(best, squared_distance(order_[i]));
    }
  }
  return best;
}

}  // namespace breast
