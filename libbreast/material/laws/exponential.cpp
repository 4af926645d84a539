// SPDX-License-Identifier: GPL-3.0-or-later
// Equation (10): W = a (exp(b (I1 − 3)) − 1) + c (I2 − 3); Veronda–Westmann when c = −ab/2.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "material/laws/laws.hpp"

namespace breast {

namespace {

constexpr int newton_steps = 60;  // a dozen suffice for b near one

LawValue evaluate(const double* c, double u, double v) {
  const double grown = std::exp(c[1] * u);
  LawValue value;
  value.w = c[0] * std::expm1(c[1] * u) + c[2] * v;
  value.w1 = c[0] * c[1] * grown;
  value.w2 = c[2];
  value.w11 = c[0] * c[1] * c[1] * grown;
  return value;
}

// exp overflows at 709; 50 leaves room for products of stresses and lengths.
bool defined(const double* c, double u, double) {
  return c[1] * u <= 50.0;
}

// Of b, the only constant in which W is not linear: W1 = a b exp(b u).
LawSlope shape_slope(const double* c, std::size_t, double u, double) {
  return {c[0] * (1 + c[1] * u) * std::exp(c[1] * u), 0};
}

// The smallest value of e^{b(λ²+2/λ−3)}/λ² over uniaxial stretches λ, for b > 0: 0.929 at b = 4.4, 0.743
// at b = 1. All shear moduli stay positive while ab e^{b(I1−3)} + cλ² > 0 on the weakest plane, that is,
// while −c is below this value times ab. The minimum lies where bλ³ − λ − b = 0, λ > 1; from the right
// Newton's method falls to it without passing it.
double bound(double b) {
  double stretch = 1 + 1 / b;
  for (int i = 0; i < newton_steps; ++i) {
    const double square = stretch * stretch;
    stretch -= (b * square * stretch - stretch - b) / (3 * b * square - 1);
  }
  return std::exp(b * (stretch * stretch + 2 / stretch - 3)) / (stretch * stretch);
}

std::string refusal(const double* c) {
  if (!(c[0] > 0) || !(c[1] > 0)) return "a and b must be positive";
  const double most = bound(c[1]);
  if (c[2] > -most * c[0] * c[1]) return "";
  return message("c = ", c[2], " Pa loses ellipticity: with b = ", c[1], " it must exceed -", most,
                 " ab = ", -most * c[0] * c[1], " Pa (Veronda-Westmann has c = -ab/2)");
}

std::optional<double> margin(const double* c) {
  if (!(c[0] > 0 && c[1] > 0)) return {};
  const double margin = 1 - std::max(0.0, -c[2]) / (bound(c[1]) * c[0] * c[1]);
  return margin > 0 ? std::optional<double>(margin) : std::nullopt;
}

}  // namespace

const LawKind& laws::exponential() {
  static const LawKind kind{
      "exponential",
      {{"a", "Pa", ConstantRole::low_order},
       {"b", "", ConstantRole::shape},
       {"c", "Pa", ConstantRole::low_order}},
      evaluate,
      defined,
      shape_slope,
      refusal,
      margin,
      {},
      {"uncoupled hyperelastic", "<W>({a})*(exp(({b})*(I1-3))-1)+({c})*(I2-3)</W>"}};
  return kind;
}

}  // namespace breast
