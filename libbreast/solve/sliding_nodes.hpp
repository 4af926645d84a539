// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that slide on a smooth surface: an exact bilateral constraint, φ(x) = c. Every node has its
// own level c, that of its position in the imaged shape, so that a mesh whose nodes lie slightly
// off the surface is not moved onto it.
//
// Newton's method sees the constraint in three places: the increment is held along the normal at
// the present x; the force λ∇φ of the surface turns as the node slides, which adds −λ∇²φ to the
// tangent; and every trial is put back on its level.
#pragma once

#include <memory>
#include <vector>

#include "solve/constraints.hpp"
#include "solve/term.hpp"
#include "surface/level_surface.hpp"

namespace breast {

/// The level of a wall node of the imaged shape at `place` (mm). Throws Error (input) if the
/// surface is not defined there.
Level level_at_wall_node(const LevelSurface& surface, int node, const Vec3& place);

class SlidingNodes {
 public:
  /// `nodes` are in ascending order; `imaged` (3 per node, mm) gives the levels. Throws Error
  /// (input) for a node at which the surface is not defined.
  SlidingNodes(std::shared_ptr<const LevelSurface> surface, std::vector<int> nodes,
               const Eigen::VectorXd& imaged);

  const std::vector<int>& nodes() const { return cells_.nodes; }
  /// Adds to `all` the constraint that no node leaves its level, to first order at x. False if a
  /// node is beyond the surface.
  bool hold(const Eigen::VectorXd& x, Constraints& all) const;
  /// Moves the nodes back to their levels along the gradient. Returns −1, or a node that has left
  /// the region in which the surface is defined.
  int restore(Eigen::VectorXd& x) const;
  /// The displacements (3 per node, mm), within the constraints `held`, that return the nodes to
  /// their levels to first order; empty if a node is beyond the surface.
  Eigen::VectorXd way_back(const Eigen::VectorXd& x, const Constraints& held) const;
  /// Adds the rotation of the surface's force to the requested tangents; `forces.r` is complete
  /// except for that force. False where a node is beyond the surface.
  bool add_curvature(const State& state, const Request& request, const Forces& forces) const;

 private:
  std::shared_ptr<const LevelSurface> surface_;
  Cells cells_;  // one node each
  std::vector<double> levels_;
};

}  // namespace breast
