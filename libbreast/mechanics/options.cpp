// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/options.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/table.hpp"
#include "material/set_parameter.hpp"

namespace breast {

namespace {

template <class Value>
Value pick(const std::string& name, const char* option,
           std::initializer_list<std::pair<const char*, Value>> choices) {
  std::string known;
  for (const auto& [text, value] : choices) {
    if (name == text) return value;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw input_error(option, " '", name, "' is unknown: use one of ", known);
}

}  // namespace

namespace {

void take_materials(const MechanicsTexts& texts, MechanicsOptions& model) {
  MaterialSet& materials = model.materials;
  if (!texts.materials.empty()) {
    materials = load_materials(texts.materials);
    take_supports_of_set(model);
  }
  if (materials.name.empty()) throw input_error("--materials: no material set is given");
  scale_materials(materials, texts.scale);
  SkinBehaviour& skin = materials.skin;
  if (texts.skin_compression) skin.kept = *texts.skin_compression / 100;
  if (texts.skin_smoothing) skin.smoothing = *texts.skin_smoothing;
  if (texts.skin_prestretch) skin.prestretch = *texts.skin_prestretch / 100;
  check_skin(skin, "skin");
}

}  // namespace

MechanicsOptions mechanics_options(const MechanicsTexts& texts, MechanicsOptions model) {
  take_materials(texts, model);
  if (!texts.element.empty()) {
    model.element = pick<Element>(texts.element, "--element",
                                  {{"q1p0", Element::q1p0}, {"q2p1", Element::q2p1}});
  }
  if (!texts.invariants.empty()) {
    model.invariants =
        pick<Invariants>(texts.invariants, "--invariants",
                         {{"isochoric", Invariants::isochoric}, {"plain", Invariants::plain}});
  }
  if (!texts.bulk_ratio.empty()) model.bulk_ratio = parse_bulk_ratio(texts.bulk_ratio);
  if (!texts.wall.empty()) model.wall = wall_support(texts.wall);
  if (!texts.cut.empty()) {
    model.cut = cut_support(texts.cut);
  } else if (const SupportPtr rest = model.cut->beside(*model.wall)) {
    model.cut = rest;  // its wall was replaced
  }
  model.solver = pick<SolverOption>(texts.solver, "--solver",
                                    {{"auto", SolverOption::automatic},
                                     {"direct", SolverOption::direct},
                                     {"multigrid", SolverOption::multigrid}});
  return model;
}

namespace {
constexpr const char* no_bulk_ratio = "incompressible";
}

double parse_bulk_ratio(const std::string& text) {
  if (text == no_bulk_ratio) return 0;
  const std::optional<double> ratio = number_in(text);
  if (!ratio || !(*ratio >= 1 && *ratio <= 1e9)) {
    throw input_error("--bulk-ratio '", text, "': give '", no_bulk_ratio,
                      "' or a ratio of bulk to shear modulus from 1 to 1e9, for example 1000");
  }
  return *ratio;
}

std::string bulk_ratio_text(double ratio) {
  return ratio > 0 ? format_number(ratio) : no_bulk_ratio;
}

void take_supports_of_set(MechanicsOptions& options) {
  const MaterialSet& set = options.materials;
  try {
    if (!set.wall.empty()) options.wall = wall_support(set.wall);
    if (!set.cut.empty()) options.cut = cut_support(set.cut);
  } catch (const Error& error) {
    throw input_error("materials ", set.name, ": ", error.what());
  }
}

MaterialSet set_with_supports(const MechanicsOptions& options) {
  MaterialSet set = options.materials;
  for (const SupportPtr& support : {options.wall, options.cut}) {
    const std::string text = support->text();
    const bool usual = text == default_support(support->place())->text();
    (support->place() == SupportPlace::wall ? set.wall : set.cut) = usual ? "" : text;
  }
  return set;
}

std::vector<std::string> model_parameters(const MechanicsOptions& options) {
  std::vector<std::string> names = set_parameters(options.materials);
  for (const SupportPtr& support : {options.wall, options.cut}) {
    for (const std::string& name : support->parameters()) names.push_back(name);
  }
  return names;
}

void scale_model(MechanicsOptions& options, const std::string& parameter, double factor) {
  for (SupportPtr* support : {&options.wall, &options.cut}) {
    const std::vector<std::string> names = (*support)->parameters();
    if (std::find(names.begin(), names.end(), parameter) == names.end()) continue;
    *support = (*support)->scaled(parameter, factor);
    return;
  }
  if (scale_set(options.materials, parameter, factor)) return;
  std::string names = "stiffness";
  for (const std::string& name : model_parameters(options)) names += ", " + name;
  throw input_error("materials ", options.materials.name, ": no '", parameter,
                    "' to scale; choose one of ", names);
}

std::string describe_model(const MechanicsOptions& options) {
  const MaterialSet& set = options.materials;
  std::string sentence = options.wall->clause() + "; " + options.cut->clause();
  sentence +=
      message("; fat has an initial shear modulus of ",
              std::round(set.law(Tissue::fat).shear_modulus()), " Pa (materials ", set.name, ")");
  if (set.skin.kept < 1) {
    sentence += message("; skin wrinkles where it is compressed, with ", 100 * set.skin.kept,
                        " % of its stiffness remaining");
  }
  if (set.skin.prestretch > 0) {
    sentence += message("; skin is stretched by ", 100 * set.skin.prestretch,
                        " % in the stress-free shape");
  }
  return sentence;
}

const char* element_name(Element element) {
  return element == Element::q1p0 ? "q1p0" : "q2p1";
}

const char* invariants_name(Invariants invariants) {
  return invariants == Invariants::isochoric ? "isochoric" : "plain";
}

Estimate estimate_from_name(const std::string& name) {
  return pick<Estimate>(name, "--estimate",
                        {{"none", Estimate::none}, {"step", Estimate::step}, {"q2", Estimate::q2}});
}

}  // namespace breast
