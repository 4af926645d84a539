// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/multigrid/aggregates.hpp"

namespace breast {

Aggregates aggregate(const StrongCouplings& couplings) {
  const int nodes = int(couplings.start.size()) - 1;
  Aggregates out;
  out.of.assign(std::size_t(nodes), -1);
  const auto begin = [&](int i) { return couplings.start[i]; };
  const auto end = [&](int i) { return couplings.start[i + 1]; };
  for (int i = 0; i < nodes; ++i) {
    bool free = out.of[i] < 0 && end(i) > begin(i);
    for (long k = begin(i); k < end(i) && free; ++k) free = out.of[couplings.node[k]] < 0;
    if (!free) continue;
    for (long k = begin(i); k < end(i); ++k) out.of[couplings.node[k]] = out.count;
    out.of[i] = out.count++;
  }
  const std::vector<int> first = out.of;  // so that aggregates grow by one layer only
  for (int i = 0; i < nodes; ++i) {
    double most = 0;
    for (long k = begin(i); k < end(i) && first[i] < 0; ++k) {
      const int there = first[couplings.node[k]];
      if (there < 0 || couplings.strength[k] <= most) continue;
      most = couplings.strength[k];
      out.of[i] = there;
    }
  }
  for (int i = 0; i < nodes; ++i) {
    if (out.of[i] >= 0 || end(i) == begin(i)) continue;
    for (long k = begin(i); k < end(i); ++k) {
      if (out.of[couplings.node[k]] < 0) out.of[couplings.node[k]] = out.count;
    }
    out.of[i] = out.count++;
  }
  return out;
}

}  // namespace breast
