// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/law.hpp"

#include "core/error.hpp"
#include "core/table.hpp"
#include "material/laws/laws.hpp"

namespace breast {

std::string ConstantKind::column() const {
  return std::string(name) + (unit.empty() ? "" : "_" + std::string(unit));
}

const LawKind& law_kind(std::string_view name) {
  std::string choices;
  for (const LawKind* kind : law_kinds()) {
    if (kind->name == name) return *kind;
    choices += (choices.empty() ? "" : ", ") + std::string(kind->name);
  }
  throw input_error("material law '", name, "' is unknown: use one of ", choices);
}

Law::Law() : kind(&laws::neo_hookean()) {}

Law::Law(std::string_view name, std::vector<double> values)
    : kind(&law_kind(name)), constants(std::move(values)) {}

double Law::shear_modulus() const {
  const LawValue rest = evaluate(3, 3);
  return 2 * (rest.w1 + rest.w2);
}

Law Law::scaled(double factor) const {
  Law law = *this;
  for (std::size_t i = 0; i < law.constants.size(); ++i) {
    if (kind->constants[i].is_stiffness()) law.constants[i] *= factor;
  }
  return law;
}

// W is linear in every stiffness: its derivative is the law with that constant alone.
LawSlope Law::slope(std::size_t index, double i1, double i2) const {
  if (!kind->constants[index].is_stiffness()) {
    if (kind->shape_slope == nullptr) {
      throw input_error("law ", kind->name, ": it declares no derivative with respect to ",
                        kind->constants[index].name, "; leave this parameter out");
    }
    return kind->shape_slope(constants.data(), index, i1 - 3, i2 - 3);
  }
  Law alone = *this;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    if (kind->constants[i].is_stiffness()) alone.constants[i] = i == index ? 1 : 0;
  }
  return alone.scale_slope(i1, i2);
}

LawSlope Law::scale_slope(double i1, double i2) const {
  const LawValue value = evaluate(i1, i2);
  return {value.w1, value.w2};
}

std::string Law::describe() const {
  std::string text(kind->name);
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const ConstantKind& constant = kind->constants[i];
    text += (i == 0 ? " " : ", ") + std::string(constant.name) + " " + format_number(constants[i]);
    if (!constant.unit.empty()) text += " " + std::string(constant.unit);
  }
  return text;
}

}  // namespace breast
