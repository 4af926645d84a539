// SPDX-License-Identifier: GPL-3.0-or-later
// Energies, forces and tangents of the cells of a term. All are kept before they are added, so that sums are
// made in the order of the cells whatever the number of threads.
#pragma once

#include <vector>

#include "solve/term.hpp"

namespace breast {

struct CellResults {
  /// For cells without pressures; with room for tangents if the request asks for one.
  CellResults(const Cells& over, const Request& request);

  bool with_tangent() const { return !matrices.empty(); }
  double* residual(int cell) { return residuals.data() + std::size_t(cell) * components; }
  double* matrix(int cell) { return matrices.data() + std::size_t(cell) * components * components; }
  /// Adds what was kept. `scatter` is that of the cells, and is not needed without an assembled matrix.
  void add_to(const Request& request, const ScatterMap* scatter, Forces& forces) const;

  const Cells& cells;
  std::size_t components;  ///< of the forces of a cell: 3 per node
  std::vector<double> energies, residuals, matrices;
};

/// The nodes of all cells, ascending.
std::vector<int> nodes_of_cells(const Cells& cells);

}  // namespace breast
