// SPDX-License-Identifier: GPL-3.0-or-later
// The elimination tree of a symmetric node matrix in fronts (supernodes): the symbolic analysis of
// a multifrontal Cholesky factorisation.
#pragma once

#include <vector>

#include "solve/node_matrix.hpp"

namespace breast {

/// Fronts are numbered children first; columns and rows are in elimination order. Front f
/// eliminates columns first_column[f] … first_column[f+1]−1; its rows are those columns and then
/// the rows of L below them. Its panel of L is rows × columns, column-major.
struct FrontTree {
  int unknowns = 0;
  std::vector<int> order;               ///< elimination order → unknown
  std::vector<int> first_column;        ///< fronts + 1
  std::vector<long> row_start;          ///< fronts + 1, into rows and in_parent
  std::vector<int> rows;                ///< ascending within a front
  std::vector<int> in_parent;           ///< place of a row in the parent's rows (own columns: −1)
  std::vector<int> parent;              ///< −1: a root
  std::vector<int> child_start, child;  ///< children of front f: child[child_start[f] …]
  std::vector<int> subtree;             ///< first front of the subtree of f, which ends at f
  std::vector<long> panel_start;        ///< fronts + 1, into the values of L
  std::vector<long> entry_start;        ///< fronts + 1, into source and target
  std::vector<int> source, target;      ///< matrix value → value of the front's panel
  std::vector<double> work;             ///< flops of the subtree of f

  int count() const { return int(parent.size()); }
  int columns(int f) const { return first_column[f + 1] - first_column[f]; }
  int height(int f) const { return int(row_start[f + 1] - row_start[f]); }
  /// Entries of L as stored, and work of one factorisation (multiplications and additions).
  double stored_entries() const { return double(panel_start.back()); }
  double flops() const;
};

/// Nested dissection of the node graph (METIS), columns merged into fronts where few zeros enter
/// (CHOLMOD's rules; merging more was measured and gains nothing).
FrontTree make_front_tree(const NodePattern& pattern);

}  // namespace breast
