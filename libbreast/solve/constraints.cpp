// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/constraints.hpp"

#include <Eigen/Geometry>

namespace breast {

void Constraints::hold(int node, const Vec3& increment) {
  set(node, {Mat3::Identity(), {true, true, true}, increment});
}

void Constraints::hold_normal(int node, const Vec3& normal, double increment) {
  NodeConstraint constraint;
  constraint.axes.col(0) = normal;
  constraint.axes.col(1) = normal.unitOrthogonal();
  constraint.axes.col(2) = normal.cross(constraint.axes.col(1));
  constraint.held = {true, false, false};
  constraint.increment = Vec3(increment, 0, 0);
  set(node, constraint);
}

void Constraints::hold_along(int node, const Vec3& normal, double increment) {
  const NodeConstraint* before = at(node);
  if (before == nullptr) {
    hold_normal(node, normal, increment);
    return;
  }
  NodeConstraint both = *before;
  Vec3 rest = normal;
  for (int i = 0; i < 3; ++i) {
    if (before->held[i]) rest -= rest.dot(before->axes.col(i)) * before->axes.col(i);
  }
  const double part = rest.norm();
  if (!(part > 1e-6)) return;
  // The first free axis is aligned with the remaining part of the normal, and the other follows.
  int first = 0;
  while (before->held[first]) ++first;
  const int second = (first + 1) % 3, third = (first + 2) % 3;
  both.axes.col(first) = rest / part;
  if (before->held[second] != before->held[third]) {
    const int kept = before->held[second] ? second : third,
              free = before->held[second] ? third : second;
    both.axes.col(free) = both.axes.col(first).cross(both.axes.col(kept));
  } else if (!before->held[second]) {
    both.axes.col(second) = both.axes.col(first).unitOrthogonal();
    both.axes.col(third) = both.axes.col(first).cross(both.axes.col(second));
  }
  both.held[first] = true;
  both.increment[first] = increment / part;
  set(node, both);
}

void Constraints::set(int node, const NodeConstraint& constraint) {
  if (index_[node] < 0) {
    index_[node] = int(list_.size());
    list_.push_back(constraint);
  } else {
    list_[index_[node]] = constraint;
  }
}

void Constraints::zero_increments() {
  for (NodeConstraint& c : list_) c.increment.setZero();
}

bool Constraints::any_increment() const {
  for (const NodeConstraint& c : list_) {
    for (int i = 0; i < 3; ++i) {
      if (c.held[i] && c.increment[i] != 0) return true;
    }
  }
  return false;
}

Eigen::VectorXd Constraints::increments() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3L * nodes());
  for (int node = 0; node < nodes(); ++node) {
    const NodeConstraint* c = at(node);
    if (c == nullptr) continue;
    for (int i = 0; i < 3; ++i) {
      if (c->held[i]) out.segment<3>(3L * node) += c->increment[i] * c->axes.col(i);
    }
  }
  return out;
}

void Constraints::project(Eigen::VectorXd& v) const {
  for (int node = 0; node < nodes(); ++node) {
    const NodeConstraint* c = at(node);
    if (c == nullptr) continue;
    for (int i = 0; i < 3; ++i) {
      if (!c->held[i]) continue;
      const Vec3 axis = c->axes.col(i);
      auto part = v.segment<3>(3L * node);
      part -= axis.dot(part) * axis;
    }
  }
}

void Constraints::to_axes(Eigen::VectorXd& v) const {
  for (int node = 0; node < nodes(); ++node) {
    const NodeConstraint* c = at(node);
    if (c != nullptr)
      v.segment<3>(3L * node) = (c->axes.transpose() * v.segment<3>(3L * node)).eval();
  }
}

void Constraints::from_axes(Eigen::VectorXd& v) const {
  for (int node = 0; node < nodes(); ++node) {
    const NodeConstraint* c = at(node);
    if (c != nullptr) v.segment<3>(3L * node) = (c->axes * v.segment<3>(3L * node)).eval();
  }
}

}  // namespace breast
