// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/spread.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

Spread spread(const std::vector<Weighted>& values) {
  Spread out;
  double total = 0, n = 0;
  for (const auto& [value, weight] : values) {
    if (!(weight > 0)) continue;
    out.low = n == 0 ? value : std::min(out.low, value);
    out.high = n == 0 ? value : std::max(out.high, value);
    n += 1, total += weight;
    out.mean += weight * value;
  }
  if (n == 0) return out;
  out.mean /= total;
  double square = 0;
  for (const auto& [value, weight] : values) {
    if (weight > 0) square += weight * (value - out.mean) * (value - out.mean);
  }
  out.sd = n > 1 ? std::sqrt(n / (n - 1) * square / total) : 0;
  return out;
}

}  // namespace breast
