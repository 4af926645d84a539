// SPDX-License-Identifier: GPL-3.0-or-later
// W = α10 (I1 − 3), where α10 is half the shear modulus.
#include "material/laws/laws.hpp"

namespace breast {

namespace {

LawValue evaluate(const double* c, double u, double) {
  return {c[0] * u, c[0], 0, 0, 0, 0};
}

std::optional<double> margin(const double* c) {
  return c[0] >= 0 ? std::optional<double>(1) : std::nullopt;
}

}  // namespace

const LawKind& laws::neo_hookean() {
  static const LawKind kind{"neo_hookean",
                            {{"a10", "Pa", ConstantRole::low_order}},
                            evaluate,
                            nullptr,
                            nullptr,
                            nullptr,
                            margin,
                            {"NEO HOOKE", "{a10},{D1}"},
                            {"Mooney-Rivlin", "<c1>{a10}</c1><c2>0</c2>"}};
  return kind;
}

}  // namespace breast
