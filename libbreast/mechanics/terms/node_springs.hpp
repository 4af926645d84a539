// SPDX-License-Identifier: GPL-3.0-or-later
// Springs from single nodes to their stress-free places X as a term. Which force a spring has is left
// to the support that is made of them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/types.hpp"
#include "solve/cells.hpp"
#include "solve/term.hpp"

namespace breast {

class NodeSprings : public Term {
 public:
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override { return cells_.nodes; }
  /// Contribution to r (µN, 3 per node).
  Eigen::VectorXd forces(const State& state) const;
  /// Force of the springs on the body, µN.
  Vec3 force_on_body(const State& state) const;

 protected:
  NodeSprings() { cells_.nodes_per_cell = 1; }

  /// Energy and force of one spring, and the derivatives of the force.
  struct Spring {
    double energy = 0;
    Vec3 force{0, 0, 0};                                       ///< ∂U/∂x
    Mat3 tangent = Mat3::Zero(), by_reference = Mat3::Zero();  ///< ∂²U/∂x², ∂²U/∂x∂X
  };
  /// The i-th spring; nothing at a state for which the support is not defined.
  virtual std::optional<Spring> spring(const State& state, int i) const = 0;

  Cells cells_;  // one node each
};

}  // namespace breast
