// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement boundary conditions, each in the axes of its node, for the chest wall, rollers and
// plates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// A node whose displacement increment is prescribed along some of its own axes.
struct NodeConstraint {
  Mat3 axes = Mat3::Identity();                   ///< orthonormal columns, in global coordinates
  std::array<bool, 3> held{false, false, false};  ///< per axis
  Vec3 increment{0, 0, 0};                        ///< mm along the held axes, others ignored
};

/// At most one constraint per node; a new constraint on a node replaces the former.
class Constraints {
 public:
  explicit Constraints(int nodes) : index_(static_cast<std::size_t>(nodes), -1) {}

  /// Prescribes all three components as `increment` (global axes).
  void hold(int node, const Vec3& increment = Vec3::Zero());
  /// Prescribes only the component along a unit `normal`; the node slides in the plane.
  void hold_normal(int node, const Vec3& normal, double increment = 0);
  /// Also holds the component along a unit `normal` of a node that may be held already (a symmetry
  /// plane, a sliding surface). Nothing changes if the normal has no freedom left.
  void hold_along(int node, const Vec3& normal, double increment = 0);
  void set(int node, const NodeConstraint& constraint);

  int nodes() const { return int(index_.size()); }
  /// The constraint of a node; null if the node is free.
  const NodeConstraint* at(int node) const {
    return index_[node] < 0 ? nullptr : &list_[index_[node]];
  }
  bool held(int node, int axis) const {
    const NodeConstraint* c = at(node);
    return c != nullptr && c->held[axis];
  }
  /// Sets all increments to zero, as correctors and preconditioners need.
  void zero_increments();
  bool any_increment() const;

  /// The prescribed increments as a global vector (3 per node), zero elsewhere.
  Eigen::VectorXd increments() const;
  /// v with its held components removed (global axes in and out): the free part of a residual.
  void project(Eigen::VectorXd& v) const;
  /// Global axes → node axes of constrained nodes, and back.
  void to_axes(Eigen::VectorXd& v) const;
  void from_axes(Eigen::VectorXd& v) const;

 private:
  std::vector<int> index_;
  std::vector<NodeConstraint> list_;
};

}  // namespace breast
