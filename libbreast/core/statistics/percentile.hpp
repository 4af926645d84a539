// SPDX-License-Identifier: GPL-3.0-or-later
// Median and percentiles of some values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace breast {

/// The middle value, of an even number the upper of the two; `fallback` if there are none. No value
/// may be NaN.
template <class T>
double median(std::vector<T> values, double fallback = std::numeric_limits<double>::quiet_NaN()) {
  if (values.empty()) return fallback;
  const auto place = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The value at rank `fraction` (n - 1), rounded down, of the n sorted values, without
/// interpolation; at 0.5 of an even number the lower of the two middle values, unlike median().
/// `fallback` if there are none. No value may be NaN.
template <class T>
double percentile(std::vector<T> values, double fraction,
                  double fallback = std::numeric_limits<double>::quiet_NaN()) {
  if (values.empty()) return fallback;
  const auto place = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace breast
