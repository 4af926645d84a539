// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the ranks that share a node.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "distributed/mesh_part.hpp"

namespace breast {

class Exchange {
 public:
  /// `part` must outlive this.
  Exchange(const Ranks& ranks, const MeshPart& part);

  /// Replaces what this part has at a shared node by the sum over all ranks that have the node;
  /// `values` has the same number of entries for every node. Ranks add in one order, so that all
  /// get the same bits.
  void sum(Eigen::VectorXd& values) const;
  /// Every other rank gets what a node's owner has.
  void from_owner(Eigen::VectorXd& values) const;

 private:
  const Ranks& ranks_;
  const MeshPart& part_;
  std::vector<int> all_;  // nodes of this part that others have too
};

}  // namespace breast
