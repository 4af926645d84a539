// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of nodal values over the ranks that share a node.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "distributed/mesh_part.hpp"

namespace breast {

class Exchange {
 public:
  /// `part` must outlive this object.
  Exchange(const Ranks& ranks, const MeshPart& part);

  /// Replaces this part's values at a shared node by the sum over all ranks that have the node.
  /// `values` has the same number of entries for every node. All ranks add in the same order, so
  /// that they get identical bits.
  void sum(Eigen::VectorXd& values) const;
  /// Sends the owner's values of a node to every other rank that has it.
  void from_owner(Eigen::VectorXd& values) const;

 private:
  const Ranks& ranks_;
  const MeshPart& part_;
  std::vector<int> all_;  // nodes of this part that other ranks have too
};

}  // namespace breast
