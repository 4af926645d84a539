// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/options.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "mechanics/set_supports.hpp"

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

MechanicsOptions mechanics_options(const MechanicsTexts& texts) {
  MechanicsOptions options;
  MaterialSet& materials = options.materials;
  materials = load_materials(texts.materials);
  scale_materials(materials, texts.scale);
  SkinBehaviour& skin = materials.skin;
  if (texts.skin_compression) skin.kept = *texts.skin_compression / 100;
  if (texts.skin_smoothing) skin.smoothing = *texts.skin_smoothing;
  if (texts.skin_prestretch) skin.prestretch = *texts.skin_prestretch / 100;
  check_skin(skin, "skin");
  options.element = pick<Element>(texts.element, "--element",
                                  {{"q1p0", Element::q1p0}, {"q2p1", Element::q2p1}});
  options.invariants =
      pick<Invariants>(texts.invariants, "--invariants",
                       {{"isochoric", Invariants::isochoric}, {"plain", Invariants::plain}});
  options.bulk_ratio = texts.bulk_ratio.value_or(0);
  take_supports_of_set(options);
  if (!texts.wall.empty()) options.wall = parse_wall(texts.wall);
  if (!texts.cut.empty()) {
    options.cut = parse_cut(texts.cut);
  } else if (options.cut.kind == Cut::tissue && !carries_tissue_beyond(options.wall)) {
    options.cut.kind = Cut::spring;  // of the set, whose wall was replaced
  }
  options.solver = pick<SolverOption>(texts.solver, "--solver",
                                      {{"auto", SolverOption::automatic},
                                       {"direct", SolverOption::direct},
                                       {"multigrid", SolverOption::multigrid}});
  return options;
}

namespace {

std::string describe_support(const WallOption& wall) {
  const std::string along = message(wall.stiffness.tangential);
  switch (wall.kind) {
    case WallKind::held:
      return "the breast is fixed everywhere on the chest wall, where a living breast slides";
    case WallKind::slide:
      return "the breast slides on the chest wall against " + along + " kPa per mm";
    case WallKind::spring:
      return message("the breast rests on springs at the chest wall, ", wall.stiffness.normal,
                     " kPa per mm across it and ", along, " along it");
  }
  return "";
}

}  // namespace

std::string support_options(const MechanicsOptions& options) {
  return "--wall " + describe(options.wall) + " --cut " + describe(options.cut);
}

std::string describe_model(const MechanicsOptions& options) {
  const MaterialSet& set = options.materials;
  std::string sentence = describe_support(options.wall);
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
