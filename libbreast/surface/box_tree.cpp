// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace breast {

namespace {
constexpr int leaf_size = 4;
}

BoxTree::BoxTree(std::vector<Eigen::AlignedBox3d> boxes)
    : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  tree_.reserve(2 * order_.size());
  if (!boxes_.empty()) build(0, int(boxes_.size()));
}

int BoxTree::build(int first, int count) {
  const int self = int(tree_.size());
  Eigen::AlignedBox3d box;
  for (int i = first; i < first + count; ++i) box.extend(boxes_[order_[i]]);
  tree_.push_back({box, -1, -1, first, count});
  if (count <= leaf_size) return self;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int half = count / 2;
  // Equal centres are ordered by number, so that the tree is the same on every processor.
  std::nth_element(order_.begin() + first, order_.begin() + first + half,
                   order_.begin() + first + count, [&](int a, int b) {
                     const double at_a = boxes_[a].min()[axis] + boxes_[a].max()[axis];
                     const double at_b = boxes_[b].min()[axis] + boxes_[b].max()[axis];
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  const int left = build(first, half);
  const int right = build(first + half, count - half);
  tree_[self].left = left;
  tree_[self].right = right;
  return self;
}

}  // namespace breast
