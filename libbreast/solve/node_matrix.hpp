// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric sparse matrices with three unknowns per node; the pattern is built once for many sets
// of values.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/types.hpp"
#include "solve/cells.hpp"

namespace breast {

/// The lower triangle in compressed columns, stored both by node (blocks of 3×3) and by unknown.
class NodePattern {
 public:
  /// Builds the pattern in which every node of a cell couples with every other.
  NodePattern(int nodes, const Cells& cells);

  int nodes() const { return nodes_; }
  int unknowns() const { return 3 * nodes_; }
  /// Row nodes strictly below the diagonal of a column of blocks, ascending.
  const int* rows_begin(int column) const { return rows_.data() + start_[column]; }
  int rows_count(int column) const { return start_[column + 1] - start_[column]; }

  /// Position in the value array of entry (i, k) of the diagonal block (i ≥ k), or of block `slot`
  /// (0 … rows_count−1) of a column of blocks.
  long diagonal(int column, int i, int k) const { return column_start_[3 * column + k] + i - k; }
  long below(int column, int slot, int i, int k) const {
    return column_start_[3 * column + k] + 3 - k + 3L * slot + i;
  }
  /// Slot of a row node in a column; the pair must couple.
  int slot(int row, int column) const;

  const std::vector<long>& column_start() const { return column_start_; }
  const std::vector<long>& row_index() const { return row_index_; }
  long values() const { return column_start_.back(); }

 private:
  int nodes_;
  std::vector<int> start_, rows_;
  std::vector<long> column_start_, row_index_;
};

/// Positions of the block (a, b) of each cell in the matrix, computed once per set of cells.
class ScatterMap {
 public:
  ScatterMap(const NodePattern& pattern, const Cells& cells);
  const Cells& cells() const { return cells_; }
  /// Slot of local row a in local column b; −1 when above the diagonal.
  int slot(int cell, int a, int b) const {
    const int n = cells_.nodes_per_cell;
    return slots_[(std::size_t(cell) * n + b) * n + a];
  }

 private:
  Cells cells_;
  std::vector<int> slots_;
};

class NodeMatrix {
 public:
  explicit NodeMatrix(std::shared_ptr<const NodePattern> pattern);

  const NodePattern& pattern() const { return *pattern_; }
  void set_zero();
  /// Adds cell matrices (3n × 3n, column-major, symmetric, one after another) of cells
  /// first … first+count−1. Sums in cell order whatever the number of threads.
  void add_cells(const ScatterMap& map, int first, int count, const double* matrices);
  /// Adds a symmetric 3×3 block at a node (for example the curvature of a contact surface).
  void add_to_node(int node, const Mat3& block);

  /// Block (row, column), row ≥ column, as a full 3×3 matrix; slot −1 means the diagonal block.
  Mat3 block(int column, int slot) const;
  void set_block(int column, int slot, const Mat3& block);
  Eigen::VectorXd diagonal() const;
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const;

  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

 private:
  std::shared_ptr<const NodePattern> pattern_;
  std::vector<double> values_;
};

}  // namespace breast
