// SPDX-License-Identifier: GPL-3.0-or-later
// The connectivity of a discretisation for solvers: the nodes of every cell (element or face).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace breast {

/// Cells with the same number of nodes each.
struct Cells {
  int nodes_per_cell = 0;
  std::vector<int> nodes;  ///< nodes_per_cell per cell
  int count() const { return nodes_per_cell == 0 ? 0 : int(nodes.size()) / nodes_per_cell; }
  const int* cell(int c) const { return nodes.data() + std::size_t(c) * nodes_per_cell; }
  /// The values (3 per node in `nodal`) of a cell's nodes, stacked.
  Eigen::VectorXd gather(int c, const Eigen::VectorXd& nodal) const {
    Eigen::VectorXd local(3L * nodes_per_cell);
    for (int a = 0; a < nodes_per_cell; ++a) {
      local.segment<3>(3L * a) = nodal.segment<3>(3L * cell(c)[a]);
    }
    return local;
  }
};

}  // namespace breast
