// SPDX-License-Identifier: GPL-3.0-or-later
// Mean, standard deviation and range of values that count with different weights.
#pragma once

#include <vector>

namespace breast {

struct Weighted {
  double value = 0, weight = 1;
};

struct Spread {
  double mean = 0, sd = 0, low = 0, high = 0;
};

/// Of the values with a weight above zero; all zero if there are none. The standard deviation is
/// √(n/(n − 1) Σ w (v − mean)² / Σ w) of n values, and zero for a single one.
Spread spread(const std::vector<Weighted>& values);

}  // namespace breast
