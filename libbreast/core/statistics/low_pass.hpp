// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothing of values on a closed curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/elementary.hpp"

namespace breast {

/// The values, at equal steps along the curve, smoothed by a Gaussian with a standard deviation of
/// `sigma` steps.
template <class T>
std::vector<T> low_pass(const std::vector<T>& values, double sigma) {
  const int n = int(values.size()), reach = std::min(n / 2, int(std::ceil(3 * sigma)));
  std::vector<T> smooth = values;
  for (int i = 0; i < n; ++i) {
    T sum = 0 * values[0];
    double total = 0;
    for (int o = -reach; o <= reach; ++o) {
      const double w = elementary::exp(-0.5 * o * o / (sigma * sigma));
      sum += w * values[(i + o + n) % n];
      total += w;
    }
    smooth[i] = sum / total;
  }
  return smooth;
}

}  // namespace breast
