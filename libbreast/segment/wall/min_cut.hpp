// SPDX-License-Identifier: GPL-3.0-or-later
// Optimal height field by minimum cut (Li, Wu, Chen, Sonka, IEEE TPAMI 28:119, 2006).
#pragma once

#include <vector>

namespace breast {

/// Columns on an nx x nz grid with `levels` candidate depths each.
struct SurfaceProblem {
  int nx = 0, nz = 0, levels = 0;
  std::vector<float>
      cost;  ///< [(k*nx + i)*levels + d]: cost of the surface at depth d of column (i,k)
  int max_step_x = 3,
      max_step_z = 3;       ///< hard limit on the difference of neighbouring columns (levels)
  double step_cost = 0.04;  ///< for every level of difference
};

/// Level per column (k*nx + i) with the least total cost; exact.
std::vector<int> optimal_surface(const SurfaceProblem& problem);

}  // namespace breast
