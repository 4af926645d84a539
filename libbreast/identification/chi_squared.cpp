// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/chi_squared.hpp"

#include <cmath>

namespace breast {

namespace {

constexpr double precision = 1e-15;
constexpr int most = 100000;

// x^a e^-x / Γ(a)
double weight(double a, double x) {
  return std::exp(a * std::log(x) - x - std::lgamma(a));
}

// P(a, x) by its series, for x below a + 1.
double lower_by_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < most && term > precision * sum; ++n) sum += term *= x / (a + n);
  return sum * weight(a, x);
}

// Q(a, x) by Legendre's continued fraction (Lentz), for x above a + 1.
double upper_by_fraction(double a, double x) {
  double b = x + 1 - a, c = 1e300, d = 1 / b, value = d;
  for (int n = 1; n < most; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    value *= c * d;
    if (std::abs(c * d - 1) < precision) break;
  }
  return value * weight(a, x);
}

}  // namespace

double chi_squared_above(double value, double freedom) {
  if (!(value > 0)) return 1;
  const double a = freedom / 2, x = value / 2;
  return x < a + 1 ? 1 - lower_by_series(a, x) : upper_by_fraction(a, x);
}

}  // namespace breast
