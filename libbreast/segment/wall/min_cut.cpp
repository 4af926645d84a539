// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/min_cut.hpp"

#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace breast {

// Node (column, d) is on the source side when the surface lies at depth d or deeper. Cutting the
// chain of a column between d and d+1 costs cost(d); the reverse arc is closed, so each chain is
// cut once.
std::vector<int> optimal_surface(const SurfaceProblem& problem) {
  const int columns = problem.nx * problem.nz, levels = problem.levels;
  // Node d = 1..levels-1; level 0 is always on the source side.
  const int chain = levels - 1;
  constexpr double closed = 1e6;
  cv::detail::GCGraph<double> graph(unsigned(columns * chain), unsigned(columns * chain * 10));
  for (int n = 0; n < columns * chain; ++n) graph.addVtx();
  const auto node = [&](int column, int d) { return column * chain + d - 1; };
  for (int column = 0; column < columns; ++column) {
    const float* cost = &problem.cost[std::size_t(column) * levels];
    // Costs are shifted to be positive: every chain is cut exactly once,
    // so the shift is a constant.
    float least = cost[0];
    for (int d = 1; d < levels; ++d) least = std::min(least, cost[d]);
    for (int d = 0; d < levels; ++d) {
      const double c = cost[d] - least;
      if (d == 0) {
        graph.addTermWeights(node(column, 1), c, levels == 2 ? cost[1] - least : 0);
      } else if (d == levels - 1) {
        if (levels > 2) graph.addTermWeights(node(column, d), 0, c);
      } else {
        graph.addEdges(node(column, d), node(column, d + 1), c, closed);
      }
    }
  }
  const auto couple = [&](int a, int b, int max_step) {
    for (int d = 1; d < levels; ++d) {
      graph.addEdges(node(a, d), node(b, d), problem.step_cost, problem.step_cost);
      // a at d or deeper forces b at d - max_step or deeper, and the other way round.
      if (d - max_step >= 1) {
        graph.addEdges(node(a, d), node(b, d - max_step), closed, 0);
        graph.addEdges(node(b, d), node(a, d - max_step), closed, 0);
      }
    }
  };
  for (int k = 0; k < problem.nz; ++k) {
    for (int i = 0; i < problem.nx; ++i) {
      const int column = k * problem.nx + i;
      if (i + 1 < problem.nx) couple(column, column + 1, problem.max_step_x);
      if (k + 1 < problem.nz) couple(column, column + problem.nx, problem.max_step_z);
    }
  }
  graph.maxFlow();
  std::vector<int> surface(columns, 0);
  for (int column = 0; column < columns; ++column) {
    for (int d = 1; d < levels && graph.inSourceSegment(node(column, d)); ++d) surface[column] = d;
  }
  return surface;
}

}  // namespace breast
