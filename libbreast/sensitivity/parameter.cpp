// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensitivity/parameter.hpp"

#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/error.hpp"
#include "material/set_parameter.hpp"

namespace breast {

namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;
constexpr const char* axis_names[3] = {"x", "y", "z"};

std::set<Tissue> tissues_of(const HexTopology& mesh) {
  std::set<Tissue> present(mesh.tissue.begin(), mesh.tissue.end());
  if (mesh.skin_model == SkinModel::membrane && !mesh.skin_faces.empty()) {
    present.insert(Tissue::skin);
  }
  return present;
}

// Only rotations towards the two axes perpendicular to gravity are offered, since a rotation
// towards its own axis changes nothing.
void add_gravity(const Vec3& gravity, const std::string& prefix, ParameterKind kind,
                 std::vector<Parameter>& all) {
  if (!(gravity.norm() > 0)) return;
  int along = 0;
  gravity.cwiseAbs().maxCoeff(&along);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == along) continue;
    Parameter parameter{prefix + axis_names[axis], kind};
    parameter.axis = axis;
    all.push_back(parameter);
  }
}

void add_constants(Tissue tissue, const Law& law, std::vector<Parameter>& all) {
  for (std::size_t i = 0; i < law.constants.size(); ++i) {
    if (law.constants[i] == 0) continue;
    Parameter parameter{
        std::string(tissue_name(tissue)) + "." + std::string(law.kind->constants[i].name),
        ParameterKind::constant, tissue, i};
    parameter.value = law.constants[i];
    all.push_back(parameter);
  }
}

// Names by which parts of the model may be scaled together.
std::vector<std::string> set_names(const MechanicsOptions& options) {
  std::vector<std::string> names = model_parameters(options);
  names.push_back("stiffness");
  return names;
}

bool is_support(const MechanicsOptions& options, const std::string& name) {
  for (const SupportPtr& support : {options.wall, options.cut}) {
    for (const std::string& own : support->parameters()) {
      if (own == name) return true;
    }
  }
  return false;
}

// The quantities in the set's covariance that have no parameter of their own yet.
void add_set_parameters(const HexMesh& state, const MechanicsOptions& options,
                        std::vector<Parameter>& all) {
  const std::vector<std::string> known = set_names(options);
  for (const std::string& name : options.materials.uncertainty.parameters) {
    const bool there =
        std::any_of(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
    if (there || std::find(known.begin(), known.end(), name) == known.end()) continue;
    Parameter parameter = set_parameter(state, options, name);
    if (!parameter.members.empty()) all.push_back(std::move(parameter));
  }
}

bool is_main(const Parameter& parameter) {
  return parameter.kind != ParameterKind::constant &&
         parameter.kind != ParameterKind::tissue_density;
}

}  // namespace

std::string Parameter::per() const {
  switch (kind) {
    case ParameterKind::scale:
    case ParameterKind::constant:
    case ParameterKind::density:
    case ParameterKind::tissue_density:
    case ParameterKind::skin_thickness:
    case ParameterKind::support:
    case ParameterKind::together:
      return "1";
    case ParameterKind::thickness:
    case ParameterKind::standoff:
    case ParameterKind::detector:
      return "mm";
    case ParameterKind::gravity:
    case ParameterKind::imaged_gravity:
    case ParameterKind::angle:
      return "degree";
  }
  throw std::logic_error("no kind of parameter");
}

bool Parameter::of_plates() const {
  return kind == ParameterKind::thickness || kind == ParameterKind::standoff ||
         kind == ParameterKind::detector || kind == ParameterKind::angle;
}

std::vector<Parameter> all_parameters(const HexMesh& state, const MechanicsOptions& options,
                                      const Vec3& imaged_gravity) {
  return all_parameters(state, state, options, imaged_gravity);
}

std::vector<Parameter> all_parameters(const HexMesh& imaged, const HexMesh& state,
                                      const MechanicsOptions& options, const Vec3& imaged_gravity) {
  std::vector<Parameter> all;
  const std::set<Tissue> present = tissues_of(imaged);
  for (const Tissue tissue : present) {
    all.push_back({std::string(tissue_name(tissue)), ParameterKind::scale, tissue});
  }
  for (const Tissue tissue : present) add_constants(tissue, options.materials.law(tissue), all);
  if (imaged_gravity.norm() > 0 || state.gravity.norm() > 0) {
    all.push_back({"density", ParameterKind::density});
    for (const Tissue tissue : std::set<Tissue>(imaged.tissue.begin(), imaged.tissue.end())) {
      all.push_back(
          {std::string(tissue_name(tissue)) + ".density", ParameterKind::tissue_density, tissue});
    }
  }
  if (state.skin_model == SkinModel::membrane) {
    all.push_back({"skin_thickness", ParameterKind::skin_thickness, Tissue::skin});
  }
  for (const SupportPtr& support : {options.wall, options.cut}) {
    for (const std::string& name : support->parameters()) {
      all.push_back({name, ParameterKind::support});
    }
  }
  add_set_parameters(imaged, options, all);
  add_gravity(state.gravity, "gravity_", ParameterKind::gravity, all);
  add_gravity(imaged_gravity, "imaged_gravity_", ParameterKind::imaged_gravity, all);
  if (state.contact) {
    all.push_back({"thickness", ParameterKind::thickness});
    all.push_back({"standoff", ParameterKind::standoff});
    all.push_back({"detector", ParameterKind::detector});
    all.push_back({"angle", ParameterKind::angle});
  }
  return all;
}

Parameter set_parameter(const HexMesh& state, const MechanicsOptions& options,
                        const std::string& name) {
  const std::vector<std::string> known = set_names(options);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    std::string names;
    for (const std::string& one : known) names += (names.empty() ? "" : ", ") + one;
    throw input_error("material parameter '", name, "': use ", names);
  }
  Parameter sum{name, ParameterKind::together};
  if (is_support(options, name)) sum.members.push_back({name, ParameterKind::support});
  const MaterialSet& set = options.materials;
  const std::set<Tissue> present = tissues_of(state);
  for (const LawConstant& at : constants_of(set, name)) {
    if (!present.contains(at.tissue)) continue;
    Parameter one{name, ParameterKind::constant, at.tissue, at.constant};
    one.value = set.law(at.tissue).constants[at.constant];
    sum.members.push_back(one);
  }
  return sum;
}

std::vector<Parameter> pick_parameters(const std::vector<Parameter>& all, const std::string& list) {
  std::vector<Parameter> picked;
  const auto pick = [&](const auto& wanted) {
    bool any = false;
    for (const Parameter& parameter : all) {
      if (!wanted(parameter)) continue;
      any = true;
      const bool there = std::any_of(picked.begin(), picked.end(),
                                     [&](const Parameter& p) { return p.name == parameter.name; });
      if (!there) picked.push_back(parameter);
    }
    return any;
  };
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const bool found = word == "main"  ? pick(is_main)
                       : word == "all" ? pick([](const Parameter&) { return true; })
                                       : pick([&](const Parameter& p) { return p.name == word; });
    if (found) continue;
    std::string known = "main, all";
    for (const Parameter& parameter : all) known += ", " + parameter.name;
    throw input_error("parameter '", word, "' does not influence this state: use ", known);
  }
  if (picked.empty()) throw input_error("no parameter named; 'main' names the usual ones");
  return picked;
}

Vec3 turned_gravity(const Vec3& gravity, int axis) {
  const Vec3 along = gravity.normalized();
  Vec3 towards = Vec3::Unit(axis);
  towards -= towards.dot(along) * along;
  return gravity.norm() * radians_per_degree * towards.normalized();
}

}  // namespace breast
