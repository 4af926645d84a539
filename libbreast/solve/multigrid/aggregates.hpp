// SPDX-License-Identifier: GPL-3.0-or-later
// Aggregation of nodes into the nodes of the next coarser multigrid level (Vanek, Mandel and
// Brezina 1996, "Algebraic multigrid by smoothed aggregation", Computing 56).
#pragma once

#include <cmath>
#include <vector>

#include "solve/multigrid/block_matrix.hpp"

namespace breast {

struct Aggregates {
  int count = 0;
  /// Aggregate of every node; −1 for a node without couplings, which is left to the smoother.
  std::vector<int> of;
};

/// Couplings a multigrid should respect: |A_ij|² > threshold² |A_ii| |A_jj| (Frobenius norms).
struct StrongCouplings {
  std::vector<long> start{0};
  std::vector<int> node;
  std::vector<double> strength;
};

template <int B>
StrongCouplings strong_couplings(const BlockMatrix<B, B>& a, double threshold) {
  std::vector<double> size(std::size_t(a.rows), 0.0);
  for (int i = 0; i < a.rows; ++i) {
    for (long k = a.start[i]; k < a.start[i + 1]; ++k) {
      if (a.column[k] == i) size[i] = a.block[k].norm();
    }
  }
  StrongCouplings out;
  for (int i = 0; i < a.rows; ++i) {
    for (long k = a.start[i]; k < a.start[i + 1]; ++k) {
      const int j = a.column[k];
      const double square = a.block[k].squaredNorm();
      if (j == i || !(square > threshold * threshold * size[i] * size[j])) continue;
      out.node.push_back(j);
      out.strength.push_back(square / (size[i] * size[j]));
    }
    out.start.push_back(long(out.node.size()));
  }
  return out;
}

/// Aggregates neighbourhoods first, then the nodes left between them.
Aggregates aggregate(const StrongCouplings& couplings);

}  // namespace breast
