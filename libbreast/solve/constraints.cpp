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

void Constraints::set(int node, const NodeConstraint& constraint) {
  if (index_[node] < 0) {
    index_[node] = int(list_.size());
    list_.push_back(constraint);
  } else {
    list_[index_[node]] = constraint;
  }
}

void Constraints::release(int node) {
  if (index_[node] >= 0) list_[index_[node]].held = {false, false, false};
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
