// SPDX-License-Identifier: GPL-3.0-or-later
// Gent 1996 (Rubber Chem. Technol. 69:59): W = −½ μ J_m ln(1 − (I1 − 3)/J_m). The chains of a network end:
// the law is defined while I1 − 3 < J_m.
#include <cmath>

#include "material/laws/laws.hpp"

namespace breast {

namespace {

LawValue evaluate(const double* c, double u, double) {
  const double left = 1 - u / c[1];
  LawValue value;
  value.w = -0.5 * c[0] * c[1] * std::log(left);
  value.w1 = 0.5 * c[0] / left;
  value.w11 = 0.5 * c[0] / (c[1] * left * left);
  return value;
}

bool defined(const double* c, double u, double) {
  return u < c[1];
}

// Of J_m: W1 = ½ μ J_m / (J_m − u).
LawSlope shape_slope(const double* c, std::size_t, double u, double) {
  const double left = c[1] - u;
  return {-0.5 * c[0] * u / (left * left), 0};
}

std::string refusal(const double* c) {
  return c[1] > 0 ? "" : "J_m must be positive: the law ends where I1 - 3 reaches it";
}

// Convex and rising in I1 up to its end.
std::optional<double> margin(const double* c) {
  return c[0] > 0 && c[1] > 0 ? std::optional<double>(1) : std::nullopt;
}

}  // namespace

const LawKind& laws::gent() {
  static const LawKind kind{
      "gent",
      {{"mu", "Pa", ConstantRole::low_order}, {"J_m", "", ConstantRole::shape}},
      evaluate,
      defined,
      shape_slope,
      refusal,
      margin,
      {},
      {"uncoupled hyperelastic", "<W>-({mu})*({J_m})/2*ln(1-(I1-3)/({J_m}))</W>"}};
  return kind;
}

}  // namespace breast
