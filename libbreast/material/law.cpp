// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/law.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

// Constants by their place in Law::constants.
struct KindName {
  LawKind kind;
  std::string_view name;
  std::vector<std::string_view> constants;
};
const std::vector<KindName>& kinds() {
  static const std::vector<KindName> table = {
      {LawKind::polynomial, "polynomial", {"a10", "a01", "a20", "a02", "a11"}},
      {LawKind::exponential, "exponential", {"a", "b", "c"}},
      {LawKind::neo_hookean, "neo_hookean", {"a10"}},
      {LawKind::mooney_rivlin, "mooney_rivlin", {"a10", "a01"}},
      {LawKind::yeoh, "yeoh", {"c1", "c2", "c3"}}};
  return table;
}
const KindName& entry(LawKind kind) {
  for (const KindName& k : kinds()) {
    if (k.kind == kind) return k;
  }
  throw failed_error("unknown material law");
}

// Equation (9): W = α10 u + α01 v + α20 u² + α02 v² + α11 uv with u = I1−3, v = I2−3.
LawValue polynomial(const std::vector<double>& c, double u, double v) {
  LawValue value;
  value.w = c[0] * u + c[1] * v + c[2] * u * u + c[3] * v * v + c[4] * u * v;
  value.w1 = c[0] + 2 * c[2] * u + c[4] * v;
  value.w2 = c[1] + 2 * c[3] * v + c[4] * u;
  value.w11 = 2 * c[2];
  value.w12 = c[4];
  value.w22 = 2 * c[3];
  return value;
}

// Equation (10): W = a (exp(b (I1−3)) − 1) + c (I2−3); Veronda–Westmann when c = −ab/2.
LawValue exponential(const std::vector<double>& c, double u, double v) {
  const double grown = std::exp(c[1] * u);
  LawValue value;
  value.w = c[0] * std::expm1(c[1] * u) + c[2] * v;
  value.w1 = c[0] * c[1] * grown;
  value.w2 = c[2];
  value.w11 = c[0] * c[1] * c[1] * grown;
  return value;
}

LawValue yeoh(const std::vector<double>& c, double u) {
  LawValue value;
  value.w = u * (c[0] + u * (c[1] + u * c[2]));
  value.w1 = c[0] + u * (2 * c[1] + 3 * u * c[2]);
  value.w11 = 2 * c[1] + 6 * u * c[2];
  return value;
}

}  // namespace

LawValue Law::evaluate(double i1, double i2) const {
  const double u = i1 - 3, v = i2 - 3;
  switch (kind) {
    case LawKind::polynomial:
      return polynomial(constants, u, v);
    case LawKind::exponential:
      return exponential(constants, u, v);
    case LawKind::yeoh:
      return yeoh(constants, u);
    case LawKind::neo_hookean:
      return {constants[0] * u, constants[0], 0, 0, 0, 0};
    case LawKind::mooney_rivlin:
      return {constants[0] * u + constants[1] * v, constants[0], constants[1], 0, 0, 0};
  }
  throw failed_error("unknown material law");
}

bool Law::in_range(double i1) const {
  // exp overflows at 709; 50 leaves room for products of stresses and lengths.
  return kind != LawKind::exponential || constants[1] * (i1 - 3) <= 50.0;
}

double Law::shear_modulus() const {
  const LawValue rest = evaluate(3, 3);
  return 2 * (rest.w1 + rest.w2);
}

Law Law::scaled(double factor) const {
  Law law = *this;
  for (std::size_t i = 0; i < law.constants.size(); ++i) {
    if (kind == LawKind::exponential && i == 1) continue;  // b is an exponent, not a stiffness
    law.constants[i] *= factor;
  }
  return law;
}

std::string Law::describe() const {
  const KindName& names = entry(kind);
  std::string text(names.name);
  for (std::size_t i = 0; i < names.constants.size(); ++i) {
    text +=
        (i == 0 ? " " : ", ") + std::string(names.constants[i]) + " " + format_number(constants[i]);
    if (names.constants[i] != "b") text += " Pa";
  }
  return text;
}

LawKind law_kind_from_name(std::string_view name) {
  for (const KindName& k : kinds()) {
    if (k.name == name) return k.kind;
  }
  std::string choices;
  for (const KindName& k : kinds()) choices += (choices.empty() ? "" : ", ") + std::string(k.name);
  throw input_error("material law '", name, "' is unknown: use one of ", choices);
}

std::string_view law_kind_name(LawKind kind) {
  return entry(kind).name;
}

std::vector<std::string_view> law_constant_names(LawKind kind) {
  return entry(kind).constants;
}

}  // namespace breast
