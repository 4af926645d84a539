// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct/front_tree.hpp"

#include <cholmod.h>

#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace {

// Frees CHOLMOD's workspace in any case.
struct Analysis {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Analysis() {
    cholmod_l_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    common.nmethods = 1;
    common.postorder = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
  }
  ~Analysis() {
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
};

// Lower triangle without values.
cholmod_sparse lower_pattern(std::size_t n, std::vector<long>& starts, std::vector<long>& rows) {
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = n;
  matrix.nzmax = rows.size();
  matrix.p = starts.data();
  matrix.i = rows.data();
  matrix.stype = -1;
  matrix.itype = CHOLMOD_LONG;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;
  return matrix;
}

// The graph of nodes has three times fewer vertices than that of unknowns.
std::vector<long> node_order(const NodePattern& pattern, cholmod_common& common) {
  std::vector<long> starts{0}, rows;
  for (int b = 0; b < pattern.nodes(); ++b) {
    rows.push_back(b);
    rows.insert(rows.end(), pattern.rows_begin(b), pattern.rows_begin(b) + pattern.rows_count(b));
    starts.push_back(long(rows.size()));
  }
  cholmod_sparse graph = lower_pattern(std::size_t(pattern.nodes()), starts, rows);
  std::vector<long> order(static_cast<std::size_t>(pattern.nodes()));
  if (cholmod_l_metis(&graph, nullptr, 0, 1, order.data(), &common) == 0) {
    throw failed_error("METIS ordering failed (CHOLMOD status ", common.status, ")");
  }
  return order;
}

// Columns, rows and panels of every front, from CHOLMOD's symbolic factorisation.
void find_fronts(const NodePattern& pattern, FrontTree& tree) {
  Analysis analysis;
  std::vector<long> order;
  for (const long node : node_order(pattern, analysis.common)) {
    for (int k = 0; k < 3; ++k) order.push_back(3 * node + k);
  }
  std::vector<long> starts = pattern.column_start(), rows = pattern.row_index();
  cholmod_sparse matrix = lower_pattern(std::size_t(pattern.unknowns()), starts, rows);
  analysis.factor = cholmod_l_analyze_p(&matrix, order.data(), nullptr, 0, &analysis.common);
  if (analysis.factor == nullptr) {
    throw failed_error("Cholesky analysis failed (CHOLMOD status ", analysis.common.status,
                       ") for ", matrix.nrow, " unknowns; out of memory?");
  }
  const cholmod_factor& factor = *analysis.factor;
  const auto longs = [](const void* data) { return static_cast<const long*>(data); };
  const long fronts = long(factor.nsuper);
  tree.order.assign(longs(factor.Perm), longs(factor.Perm) + factor.n);
  tree.first_column.assign(longs(factor.super), longs(factor.super) + fronts + 1);
  tree.row_start.assign(longs(factor.pi), longs(factor.pi) + fronts + 1);
  tree.rows.assign(longs(factor.s), longs(factor.s) + factor.ssize);
}

void link(FrontTree& tree) {
  const int fronts = int(tree.first_column.size()) - 1;
  std::vector<int> front_of(static_cast<std::size_t>(tree.unknowns));
  for (int f = 0; f < fronts; ++f) {
    std::fill(front_of.begin() + tree.first_column[f], front_of.begin() + tree.first_column[f + 1],
              f);
  }
  tree.parent.assign(std::size_t(fronts), -1);
  tree.subtree.resize(std::size_t(fronts));
  tree.work.assign(std::size_t(fronts), 0);
  tree.child_start.assign(std::size_t(fronts) + 1, 0);
  tree.panel_start = {0};
  for (int f = 0; f < fronts; ++f) {
    const long columns = tree.columns(f), height = tree.height(f);
    if (height > columns) tree.parent[f] = front_of[tree.rows[tree.row_start[f] + columns]];
    tree.panel_start.push_back(tree.panel_start.back() + columns * height);
    for (long k = 0; k < columns; ++k) tree.work[f] += double((height - k) * (height - k));
  }
  for (int f = 0; f < fronts; ++f) tree.subtree[f] = f;
  for (int f = 0; f < fronts; ++f) {
    const int up = tree.parent[f];
    if (up < 0) continue;
    ++tree.child_start[up + 1];
    tree.subtree[up] = std::min(tree.subtree[up], tree.subtree[f]);
    tree.work[up] += tree.work[f];
  }
  for (int f = 0; f < fronts; ++f) tree.child_start[f + 1] += tree.child_start[f];
  tree.child.resize(std::size_t(tree.child_start.back()));
  std::vector<int> next(tree.child_start.begin(), tree.child_start.end() - 1);
  for (int f = 0; f < fronts; ++f) {
    if (tree.parent[f] >= 0) tree.child[next[tree.parent[f]]++] = f;
  }
}

// Positions of rows in the parent, and of matrix values in the panels.
void find_places(const NodePattern& pattern, FrontTree& tree) {
  const std::size_t n = std::size_t(tree.unknowns);
  std::vector<int> place(n), at(n);
  for (std::size_t i = 0; i < n; ++i) at[tree.order[i]] = int(i);
  // Values by the column that holds them after ordering.
  std::vector<long> start(n + 1, 0);
  std::vector<int> value(std::size_t(pattern.values())), row(value.size());
  const auto each = [&](const auto& use) {
    for (int j = 0; j < tree.unknowns; ++j) {
      for (long v = pattern.column_start()[j]; v < pattern.column_start()[j + 1]; ++v) {
        const int a = at[pattern.row_index()[v]], b = at[j];
        use(std::min(a, b), std::max(a, b), v);
      }
    }
  };
  each([&](int column, int, long) { ++start[column + 1]; });
  for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
  std::vector<long> next(start.begin(), start.end() - 1);
  each([&](int column, int r, long v) {
    value[next[column]] = int(v);
    row[next[column]++] = r;
  });
  tree.in_parent.assign(tree.rows.size(), -1);
  tree.entry_start = {0};
  for (int f = 0; f < tree.count(); ++f) {
    const int height = tree.height(f);
    for (int i = 0; i < height; ++i) place[tree.rows[tree.row_start[f] + i]] = i;
    for (int c = tree.first_column[f]; c < tree.first_column[f + 1]; ++c) {
      const int column = (c - tree.first_column[f]) * height;
      for (long v = start[c]; v < start[c + 1]; ++v) {
        tree.source.push_back(value[v]);
        tree.target.push_back(column + place[row[v]]);
      }
    }
    tree.entry_start.push_back(long(tree.source.size()));
    for (int k = tree.child_start[f]; k < tree.child_start[f + 1]; ++k) {
      const int child = tree.child[k];
      for (long r = tree.row_start[child] + tree.columns(child); r < tree.row_start[child + 1];
           ++r) {
        tree.in_parent[r] = place[tree.rows[r]];
      }
    }
  }
}

}  // namespace

double FrontTree::flops() const {
  double sum = 0;
  for (int f = 0; f < count(); ++f) sum += parent[f] < 0 ? work[f] : 0;
  return sum;
}

FrontTree make_front_tree(const NodePattern& pattern) {
  FrontTree tree;
  tree.unknowns = pattern.unknowns();
  find_fronts(pattern, tree);
  link(tree);
  find_places(pattern, tree);
  return tree;
}

}  // namespace breast
