// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/set_parameter.hpp"

namespace breast {

namespace {

constexpr Tissue solids[] = {Tissue::fat, Tissue::fibroglandular, Tissue::tumour, Tissue::muscle,
                             Tissue::other};

template <class Wanted>
void add_constants(const MaterialSet& set, Tissue tissue, const Wanted& wanted,
                   std::vector<LawConstant>& list) {
  const Law& law = set.law(tissue);
  for (std::size_t k = 0; k < law.constants.size(); ++k) {
    const ConstantKind& constant = law.kind->constants[k];
    if (wanted(constant) && law.constants[k] != 0) list.push_back({tissue, k});
  }
}

}  // namespace

const std::vector<std::string>& set_parameter_names() {
  static const std::vector<std::string> names{"low_order", "quadratic", "stiffness", "gland",
                                              "skin"};
  return names;
}

std::vector<LawConstant> constants_of(const MaterialSet& set, std::string_view parameter) {
  const auto all = [](const ConstantKind& constant) { return constant.is_stiffness(); };
  const auto of_role = [](ConstantRole role) {
    return [role](const ConstantKind& constant) { return constant.role == role; };
  };
  std::vector<LawConstant> list;
  if (parameter == "skin") add_constants(set, Tissue::skin, all, list);
  for (const Tissue tissue : solids) {
    if (parameter == "low_order") {
      add_constants(set, tissue, of_role(ConstantRole::low_order), list);
    }
    if (parameter == "quadratic") {
      add_constants(set, tissue, of_role(ConstantRole::quadratic), list);
    }
    const bool gland = tissue == Tissue::fibroglandular || tissue == Tissue::tumour;
    if (parameter == "stiffness" || (parameter == "gland" && gland)) {
      add_constants(set, tissue, all, list);
    }
  }
  return list;
}

std::vector<std::string> set_parameters(const MaterialSet& set) {
  std::vector<std::string> names;
  for (const std::string& name : set_parameter_names()) {
    if (name != "stiffness" && !constants_of(set, name).empty()) names.push_back(name);
  }
  return names;
}

bool scale_set(MaterialSet& set, std::string_view parameter, double factor) {
  const std::vector<LawConstant> constants = constants_of(set, parameter);
  for (const LawConstant& at : constants)
    set.laws[std::size_t(at.tissue)].constants[at.constant] *= factor;
  return !constants.empty();
}

}  // namespace breast
