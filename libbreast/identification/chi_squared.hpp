// SPDX-License-Identifier: GPL-3.0-or-later
// The chi-squared distribution.
#pragma once

namespace breast {

/// Probability that a sum of `freedom` squared standard normal deviates exceeds `value`: the upper
/// incomplete gamma function Q(freedom/2, value/2), to 1e-12.
double chi_squared_above(double value, double freedom);

}  // namespace breast
