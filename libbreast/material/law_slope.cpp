// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/law_slope.hpp"

#include <cmath>

namespace breast {

LawSlope law_slope(const Law& law, std::size_t index, double i1, double i2) {
  if (law.kind == LawKind::exponential && index == 1) {
    // W1 = a b exp(b (I1−3)).
    const double u = i1 - 3, b = law.constants[1];
    return {law.constants[0] * (1 + b * u) * std::exp(b * u), 0};
  }
  // W is linear in every other constant: its derivative is the law with that constant alone.
  Law alone = law;
  for (std::size_t i = 0; i < alone.constants.size(); ++i) {
    const bool exponent = law.kind == LawKind::exponential && i == 1;
    if (!exponent) alone.constants[i] = i == index ? 1 : 0;
  }
  const LawValue value = alone.evaluate(i1, i2);
  return {value.w1, value.w2};
}

LawSlope law_scale_slope(const Law& law, double i1, double i2) {
  const LawValue value = law.evaluate(i1, i2);
  return {value.w1, value.w2};
}

}  // namespace breast
