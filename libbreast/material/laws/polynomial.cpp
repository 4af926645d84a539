// SPDX-License-Identifier: GPL-3.0-or-later
// Equation (9): W = α10 u + α01 v + α20 u² + α02 v² + α11 uv with u = I1 − 3, v = I2 − 3.
#include "material/laws/laws.hpp"

namespace breast {

namespace {

LawValue evaluate(const double* c, double u, double v) {
  LawValue value;
  value.w = c[0] * u + c[1] * v + c[2] * u * u + c[3] * v * v + c[4] * u * v;
  value.w1 = c[0] + 2 * c[2] * u + c[4] * v;
  value.w2 = c[1] + 2 * c[3] * v + c[4] * u;
  value.w11 = 2 * c[2];
  value.w12 = c[4];
  value.w22 = 2 * c[3];
  return value;
}

// Convex and nondecreasing in u and v, and hence polyconvex under det F = 1.
std::optional<double> margin(const double* c) {
  for (int k = 0; k < 5; ++k) {
    if (!(c[k] >= 0)) return {};
  }
  if (4 * c[2] * c[3] < c[4] * c[4]) return {};
  return c[4] > 0 ? 1 - c[4] * c[4] / (4 * c[2] * c[3]) : 1;
}

}  // namespace

const LawKind& laws::polynomial() {
  static const LawKind kind{
      "polynomial",
      {{"a10", "Pa", ConstantRole::low_order},
       {"a01", "Pa", ConstantRole::low_order},
       {"a20", "Pa", ConstantRole::quadratic},
       {"a02", "Pa", ConstantRole::quadratic},
       {"a11", "Pa", ConstantRole::quadratic}},
      evaluate,
      nullptr,
      nullptr,
      nullptr,
      margin,
      {"POLYNOMIAL, N=2", "{a10},{a01},{a20},{a11},{a02},{D1},{D2}"},
      {"uncoupled hyperelastic",
       "<W>({a10})*(I1-3)+({a01})*(I2-3)+({a20})*(I1-3)^2+({a02})*(I2-3)^2+({a11})*(I1-3)*(I2-3)</W>"}};
  return kind;
}

}  // namespace breast
