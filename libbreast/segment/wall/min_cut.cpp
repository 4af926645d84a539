// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/min_cut.hpp"

#include <algorithm>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace breast {

namespace {

constexpr double closed = 1e6;

// Node (column, d) is on the source side when the surface lies at level d or deeper; d counts from
// the column's own second level, because the surface lies at its first or deeper. What is shallower
// than all nodes of a column is on the source side, what is deeper on the sink's.
class SurfaceGraph {
 public:
  explicit SurfaceGraph(const SurfaceProblem& problem)
      : problem_(problem),
        nodes_(int(problem.cost.size()) - problem.nx * problem.nz),
        graph_(unsigned(nodes_), unsigned(nodes_) * 10) {
    for (int n = 0; n < nodes_; ++n) graph_.addVtx();
  }
  /// The chain of a column: cutting it between d and d + 1 costs the surface at d. The reverse arc
  /// is closed, so each chain is cut once.
  void add_column(int column) {
    const float* cost = &problem_.cost[problem_.first[column]];
    const int levels = problem_.levels(column), top = problem_.top[column];
    // Costs are shifted to be positive: every chain is cut exactly once, so the shift is constant.
    const float least = *std::min_element(cost, cost + levels);
    for (int n = 0; n < levels; ++n) {
      const double c = cost[n] - least;
      connect(column, top + n, column, top + n + 1, c, levels > 1 ? closed : 0);
    }
  }
  /// Neighbouring columns: `cost` for every level of difference, at most `max_step` levels.
  void couple(int a, int b, double cost, int max_step) {
    const int from = std::min(problem_.top[a], problem_.top[b]) + 1,
              to = std::max(bottom(a), bottom(b));
    for (int d = from; d <= to; ++d) {
      connect(a, d, b, d, cost, cost);
      // a at d or deeper forces b at d - max_step or deeper, and the other way round.
      connect(a, d, b, d - max_step, closed, 0);
      connect(b, d, a, d - max_step, closed, 0);
    }
  }
  std::vector<int> solve() {
    graph_.maxFlow();
    std::vector<int> surface(problem_.top);
    for (int c = 0; c < int(surface.size()); ++c)
      while (surface[c] < bottom(c) && graph_.inSourceSegment(node(c, surface[c] + 1)))
        ++surface[c];
    return surface;
  }

 private:
  int bottom(int column) const { return problem_.top[column] + problem_.levels(column) - 1; }
  int node(int column, int d) const {
    return int(problem_.first[column]) - column + d - problem_.top[column] - 1;
  }
  /// An arc from one node to the other and one back. An end that is no node is source or sink.
  void connect(int a, int da, int b, int db, double forth, double back) {
    const auto side = [&](int column, int d) {  // -1 source, 1 sink
      return d <= problem_.top[column] ? -1 : d > bottom(column) ? 1 : 0;
    };
    const int sa = side(a, da), sb = side(b, db);
    if (sa == 0 && sb == 0) {
      graph_.addEdges(node(a, da), node(b, db), forth, back);
    } else if (sa == 0) {
      graph_.addTermWeights(node(a, da), sb < 0 ? back : 0, sb > 0 ? forth : 0);
    } else if (sb == 0) {
      graph_.addTermWeights(node(b, db), sa < 0 ? forth : 0, sa > 0 ? back : 0);
    }
  }

  const SurfaceProblem& problem_;
  int nodes_;
  cv::detail::GCGraph<double> graph_;
};

}  // namespace

std::vector<int> optimal_surface(const SurfaceProblem& problem) {
  if (problem.cost.size() == problem.top.size()) return problem.top;  // nothing to choose
  SurfaceGraph graph(problem);
  for (int column = 0; column < problem.nx * problem.nz; ++column) graph.add_column(column);
  for (int k = 0; k < problem.nz; ++k) {
    for (int i = 0; i < problem.nx; ++i) {
      const int column = k * problem.nx + i;
      if (i + 1 < problem.nx)
        graph.couple(column, column + 1, problem.step_cost_x, problem.max_step_x);
      if (k + 1 < problem.nz)
        graph.couple(column, column + problem.nx, problem.step_cost_z, problem.max_step_z);
    }
  }
  return graph.solve();
}

}  // namespace breast
