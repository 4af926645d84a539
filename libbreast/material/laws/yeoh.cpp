// SPDX-License-Identifier: GPL-3.0-or-later
// W = c1 u + c2 u² + c3 u³ with u = I1 − 3.
#include "material/laws/laws.hpp"

namespace breast {

namespace {

LawValue evaluate(const double* c, double u, double) {
  LawValue value;
  value.w = u * (c[0] + u * (c[1] + u * c[2]));
  value.w1 = c[0] + u * (2 * c[1] + 3 * u * c[2]);
  value.w11 = 2 * c[1] + 6 * u * c[2];
  return value;
}

std::optional<double> margin(const double* c) {
  return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 ? std::optional<double>(1) : std::nullopt;
}

}  // namespace

const LawKind& laws::yeoh() {
  static const LawKind kind{
      "yeoh",
      {{"c1", "Pa", ConstantRole::low_order},
       {"c2", "Pa", ConstantRole::quadratic},
       {"c3", "Pa", ConstantRole::quadratic}},
      evaluate,
      nullptr,
      nullptr,
      nullptr,
      margin,
      {"YEOH", "{c1},{c2},{c3},{D1},{D2},{D3}"},
      {"uncoupled hyperelastic", "<W>({c1})*(I1-3)+({c2})*(I1-3)^2+({c3})*(I1-3)^3</W>"}};
  return kind;
}

}  // namespace breast
