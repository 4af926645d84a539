// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/grid/otsu.hpp"

namespace breast {

int otsu_class(const std::vector<double>& count, int otherwise) {
  const int classes = int(count.size());
  double total = 0, sum = 0;
  for (int c = 0; c < classes; ++c) {
    total += count[c];
    sum += c * count[c];
  }
  double below = 0, below_sum = 0, best = -1;
  int place = otherwise;
  for (int c = 0; c + 1 < classes; ++c) {
    below += count[c];
    below_sum += c * count[c];
    if (below == 0 || below == total) continue;
    const double gap = below_sum / below - (sum - below_sum) / (total - below);
    const double between = below * (total - below) * gap * gap;
    if (between > best) {
      best = between;
      place = c + 1;
    }
  }
  return place;
}

}  // namespace breast
