// SPDX-License-Identifier: GPL-3.0-or-later
// Optimal height field by minimum cut (Li, Wu, Chen, Sonka, IEEE TPAMI 28:119, 2006).
#pragma once

#include <vector>

namespace breast {

/// Columns c = k*nx + i on an nx x nz grid, each with candidate levels of its own, from `top[c]` on:
/// their costs are cost[first[c]] to cost[first[c + 1] - 1]. Of neighbouring columns some levels
/// must lie within the hard limits of each other.
struct SurfaceProblem {
  int nx = 0, nz = 0;
  std::vector<int> top;
  std::vector<std::size_t> first;  ///< nx*nz + 1
  std::vector<float> cost;         ///< of the surface at a level
  int max_step_x = 3,
      max_step_z = 3;  ///< hard limit on the difference of neighbouring columns (levels)
  double step_cost_x = 0.04, step_cost_z = 0.04;  ///< for every level of difference

  int levels(int column) const { return int(first[column + 1] - first[column]); }
};

/// Level per column (k*nx + i) with the least total cost; exact.
std::vector<int> optimal_surface(const SurfaceProblem& problem);

}  // namespace breast
