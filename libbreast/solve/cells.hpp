// The couplings of a discretisation: which nodes meet in a cell (element or
// face), as solvers see it.
#pragma once

#include <vector>

namespace breast {

/// Cells with the same number of nodes each.
struct Cells {
  int nodes_per_cell = 0;
  std::vector<int> nodes;  ///< nodes_per_cell per cell
  int count() const { return nodes_per_cell == 0 ? 0 : int(nodes.size()) / nodes_per_cell; }
  const int* cell(int c) const { return nodes.data() + std::size_t(c) * nodes_per_cell; }
};

}  // namespace breast
