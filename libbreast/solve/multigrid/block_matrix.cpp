// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/multigrid/block_matrix.hpp"

namespace breast {

BlockMatrix<3, 3> full_matrix(const NodeMatrix& lower) {
  const NodePattern& pattern = lower.pattern();
  BlockMatrix<3, 3> full;
  full.rows = full.columns = pattern.nodes();
  full.start.assign(std::size_t(full.rows) + 1, 0);
  for (int column = 0; column < full.rows; ++column) {
    full.start[column + 1] += 1 + pattern.rows_count(column);
    for (int s = 0; s < pattern.rows_count(column); ++s) {
      ++full.start[pattern.rows_begin(column)[s] + 1];
    }
  }
  for (int i = 0; i < full.rows; ++i) full.start[i + 1] += full.start[i];
  full.column.resize(std::size_t(full.start.back()));
  full.block.resize(full.column.size());
  std::vector<long> next(full.start.begin(), full.start.end() - 1);
  // Columns ascend, so every row's upper neighbours arrive before its
  // diagonal: rows come out sorted.
  for (int column = 0; column < full.rows; ++column) {
    for (int s = -1; s < pattern.rows_count(column); ++s) {
      const int row = s < 0 ? column : pattern.rows_begin(column)[s];
      const Mat3 block = lower.block(column, s);
      full.column[next[row]] = column;
      full.block[next[row]++] = block;
      if (s < 0) continue;
      full.column[next[column]] = row;
      full.block[next[column]++] = block.transpose();
    }
  }
  return full;
}

}  // namespace breast
