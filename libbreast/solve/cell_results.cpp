// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cell_results.hpp"

#include <algorithm>

namespace breast {

CellResults::CellResults(const Cells& over, const Request& request)
    : cells(over), components(3 * std::size_t(over.nodes_per_cell)) {
  const std::size_t count = std::size_t(over.count());
  const bool tangent = request.matrix != nullptr || request.packed != nullptr;
  energies.resize(count);
  residuals.resize(count * components);
  matrices.resize(tangent ? count * components * components : 0);
}

void CellResults::add_to(const Request& request, const ScatterMap* scatter, Forces& forces) const {
  const int count = cells.count();
  const std::size_t entries = components * components;
  for (int c = 0; c < count; ++c) {
    forces.energy += energies[std::size_t(c)];
    for (std::size_t a = 0; a < components; ++a) {
      const long to = 3L * cells.cell(c)[a / 3] + long(a % 3);
      const double value = residuals[std::size_t(c) * components + a];
      forces.r[to] += value;
      if (request.kappa != nullptr) forces.augmented[to] += value;
      if (request.matrix != nullptr) {
        request.matrix->diagonal[to] += matrices[std::size_t(c) * entries + a * (components + 1)];
      }
    }
  }
  if (request.matrix != nullptr) {
    request.matrix->stiffness.add_cells(*scatter, 0, count, matrices.data());
  }
  if (request.packed != nullptr) {
    PackedCells& packed = request.packed->next(cells);
    for (int c = 0; c < count; ++c) packed.set(c, matrices.data() + std::size_t(c) * entries);
  }
}

std::vector<int> nodes_of_cells(const Cells& cells) {
  std::vector<int> all = cells.nodes;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace breast
