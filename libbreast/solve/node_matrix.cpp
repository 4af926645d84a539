// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/node_matrix.hpp"

#include <omp.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace breast {

NodePattern::NodePattern(int nodes, const Cells& cells) : nodes_(nodes) {
  std::vector<std::vector<int>> below(static_cast<std::size_t>(nodes));
  const int n = cells.nodes_per_cell;
  for (int c = 0; c < cells.count(); ++c) {
    const int* list = cells.cell(c);
    for (int b = 0; b < n; ++b) {
      for (int a = 0; a < n; ++a) {
        if (list[a] > list[b]) below[list[b]].push_back(list[a]);
      }
    }
  }
  start_.push_back(0);
  for (std::vector<int>& rows : below) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    start_.push_back(int(rows_.size()));
  }
  column_start_.push_back(0);
  for (int b = 0; b < nodes; ++b) {
    for (int k = 0; k < 3; ++k) {
      for (int i = k; i < 3; ++i) row_index_.push_back(3L * b + i);
      for (int s = start_[b]; s < start_[b + 1]; ++s) {
        for (int i = 0; i < 3; ++i) row_index_.push_back(3L * rows_[s] + i);
      }
      column_start_.push_back(long(row_index_.size()));
    }
  }
}

int NodePattern::slot(int row, int column) const {
  const int* begin = rows_begin(column);
  const int* end = begin + rows_count(column);
  const int* found = std::lower_bound(begin, end, row);
  if (found == end || *found != row) throw failed_error("sparsity: nodes do not couple");
  return int(found - begin);
}

ScatterMap::ScatterMap(const NodePattern& pattern, const Cells& cells) : cells_(cells) {
  const int n = cells.nodes_per_cell;
  slots_.resize(std::size_t(cells.count()) * n * n, -1);
  for (int c = 0; c < cells.count(); ++c) {
    const int* list = cells.cell(c);
    for (int b = 0; b < n; ++b) {
      for (int a = 0; a < n; ++a) {
        if (list[a] <= list[b]) continue;
        slots_[(std::size_t(c) * n + b) * n + a] = pattern.slot(list[a], list[b]);
      }
    }
  }
}

NodeMatrix::NodeMatrix(std::shared_ptr<const NodePattern> pattern)
    : pattern_(std::move(pattern)), values_(static_cast<std::size_t>(pattern_->values()), 0.0) {}

void NodeMatrix::set_zero() {
  std::fill(values_.begin(), values_.end(), 0.0);
}

// Each thread owns some columns of blocks and walks over all cells: no two threads write one value,
// and every value receives its contributions in cell order.
void NodeMatrix::add_cells(const ScatterMap& map, int first, int count, const double* matrices) {
  const Cells& cells = map.cells();
  const int n = cells.nodes_per_cell;
  const NodePattern& pattern = *pattern_;
#pragma omp parallel num_threads(threads())
  {
    const int owners = omp_get_num_threads(), mine = omp_get_thread_num();
    for (int c = 0; c < count; ++c) {
      const int* list = cells.cell(first + c);
      const double* matrix = matrices + std::size_t(c) * 9 * n * n;
      for (int b = 0; b < n; ++b) {
        const int column = list[b];
        if ((column >> 6) % owners != mine) continue;
        for (int k = 0; k < 3; ++k) {
          const double* source = matrix + std::size_t(3 * b + k) * 3 * n;
          for (int i = k; i < 3; ++i) values_[pattern.diagonal(column, i, k)] += source[3 * b + i];
          for (int a = 0; a < n; ++a) {
            const int slot = map.slot(first + c, a, b);
            if (slot < 0) continue;
            double* target = values_.data() + pattern.below(column, slot, 0, k);
            for (int i = 0; i < 3; ++i) target[i] += source[3 * a + i];
          }
        }
      }
    }
  }
}

void NodeMatrix::add_to_node(int node, const Mat3& block) {
  for (int k = 0; k < 3; ++k) {
    for (int i = k; i < 3; ++i) values_[pattern_->diagonal(node, i, k)] += block(i, k);
  }
}

Mat3 NodeMatrix::block(int column, int slot) const {
  Mat3 out;
  for (int k = 0; k < 3; ++k) {
    for (int i = slot < 0 ? k : 0; i < 3; ++i) {
      out(i, k) = values_[slot < 0 ? pattern_->diagonal(column, i, k)
                                   : pattern_->below(column, slot, i, k)];
      if (slot < 0) out(k, i) = out(i, k);
    }
  }
  return out;
}

void NodeMatrix::set_block(int column, int slot, const Mat3& block) {
  for (int k = 0; k < 3; ++k) {
    for (int i = slot < 0 ? k : 0; i < 3; ++i) {
      values_[slot < 0 ? pattern_->diagonal(column, i, k) : pattern_->below(column, slot, i, k)] =
          block(i, k);
    }
  }
}

Eigen::VectorXd NodeMatrix::diagonal() const {
  Eigen::VectorXd d(pattern_->unknowns());
  for (int b = 0; b < pattern_->nodes(); ++b) {
    for (int k = 0; k < 3; ++k) d[3 * b + k] = values_[pattern_->diagonal(b, k, k)];
  }
  return d;
}

Eigen::VectorXd NodeMatrix::multiply(const Eigen::VectorXd& v) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  const std::vector<long>& start = pattern_->column_start();
  const std::vector<long>& row = pattern_->row_index();
  for (long j = 0; j < pattern_->unknowns(); ++j) {
    double sum = values_[start[j]] * v[j];
    for (long at = start[j] + 1; at < start[j + 1]; ++at) {
      sum += values_[at] * v[row[at]];
      out[row[at]] += values_[at] * v[j];
    }
    out[j] += sum;
  }
  return out;
}

}  // namespace breast
