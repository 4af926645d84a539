// SPDX-License-Identifier: GPL-3.0-or-later
// W = α10 (I1 − 3) + α01 (I2 − 3).
#include "material/laws/laws.hpp"

namespace breast {

namespace {

LawValue evaluate(const double* c, double u, double v) {
  return {c[0] * u + c[1] * v, c[0], c[1], 0, 0, 0};
}

std::optional<double> margin(const double* c) {
  return c[0] >= 0 && c[1] >= 0 ? std::optional<double>(1) : std::nullopt;
}

}  // namespace

const LawKind& laws::mooney_rivlin() {
  static const LawKind kind{
      "mooney_rivlin",
      {{"a10", "Pa", ConstantRole::low_order}, {"a01", "Pa", ConstantRole::low_order}},
      evaluate,
      nullptr,
      nullptr,
      nullptr,
      margin,
      {"MOONEY-RIVLIN", "{a10},{a01},{D1}"},
      {"Mooney-Rivlin", "<c1>{a10}</c1><c2>{a01}</c2>"}};
  return kind;
}

}  // namespace breast
