// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/set_parameter.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr Tissue solids[] = {Tissue::fat, Tissue::fibroglandular, Tissue::tumour, Tissue::muscle,
                             Tissue::other};

// How many of the law's first constants are linear in the invariants.
std::size_t linear_terms(LawKind kind) {
  switch (kind) {
    case LawKind::polynomial:
    case LawKind::mooney_rivlin:
      return 2;
    default:
      return 1;
  }
}

bool is_stiffness(const Law& law, std::size_t constant) {
  return law_constant_names(law.kind)[constant] != "b";
}

void add_constants(const MaterialSet& set, Tissue tissue, std::size_t first, std::size_t last,
                   std::vector<LawConstant>& list) {
  const Law& law = set.law(tissue);
  for (std::size_t k = first; k < std::min(last, law.constants.size()); ++k)
    if (is_stiffness(law, k) && law.constants[k] != 0) list.push_back({tissue, k});
}

constexpr std::size_t all = 99;

template <class Set>
auto* support_of(Set& set, std::string_view parameter) {
  if (parameter == "wall") return &set.wall_support;
  if (parameter == "cut") return &set.cut_support;
  return parameter == "sternum" ? &set.sternum_support : nullptr;
}

}  // namespace

std::optional<double>* support_in(MaterialSet& set, std::string_view parameter) {
  return support_of(set, parameter);
}
const std::optional<double>* support_in(const MaterialSet& set, std::string_view parameter) {
  return support_of(set, parameter);
}

const std::vector<std::string>& set_parameter_names() {
  static const std::vector<std::string> names{"low_order", "quadratic", "stiffness", "gland",
                                              "skin",      "wall",      "cut",       "sternum"};
  return names;
}

std::vector<LawConstant> constants_of(const MaterialSet& set, std::string_view parameter) {
  std::vector<LawConstant> list;
  if (parameter == "skin") add_constants(set, Tissue::skin, 0, all, list);
  for (const Tissue tissue : solids) {
    const std::size_t linear = linear_terms(set.law(tissue).kind);
    if (parameter == "low_order") add_constants(set, tissue, 0, linear, list);
    if (parameter == "quadratic") add_constants(set, tissue, linear, all, list);
    if (parameter == "stiffness") add_constants(set, tissue, 0, all, list);
    const bool gland = tissue == Tissue::fibroglandular || tissue == Tissue::tumour;
    if (parameter == "gland" && gland) add_constants(set, tissue, 0, all, list);
  }
  return list;
}

std::vector<std::string> set_parameters(const MaterialSet& set) {
  std::vector<std::string> names;
  for (const std::string& name : set_parameter_names()) {
    const std::optional<double>* support = support_in(set, name);
    const bool there = support != nullptr
                           ? support->value_or(0) > 0
                           : name != "stiffness" && !constants_of(set, name).empty();
    if (there) names.push_back(name);
  }
  return names;
}

void scale_set(MaterialSet& set, std::string_view parameter, double factor) {
  const std::vector<LawConstant> constants = constants_of(set, parameter);
  for (const LawConstant& at : constants)
    set.laws[std::size_t(at.tissue)].constants[at.constant] *= factor;
  std::optional<double>* support = support_in(set, parameter);
  if (support != nullptr && *support) {
    **support *= factor;
  } else if (constants.empty()) {
    throw input_error("materials ", set.name, ": no '", std::string(parameter),
                      "' to scale; choose one that the set has of low_order, quadratic, "
                      "stiffness, gland, skin, wall, cut and sternum");
  }
}

}  // namespace breast
