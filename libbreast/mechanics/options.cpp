#include "mechanics/options.hpp"

#include <utility>

#include "core/error.hpp"

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

MechanicsOptions mechanics_options(const std::string& materials,
                                   const std::vector<std::string>& scale,
                                   const std::string& element, const std::string& invariants,
                                   std::optional<double> bulk_ratio, const std::string& wall,
                                   const std::string& cut, const std::string& solver) {
  MechanicsOptions options;
  options.materials = load_materials(materials);
  scale_materials(options.materials, scale);
  options.element =
      pick<Element>(element, "--element", {{"q1p0", Element::q1p0}, {"q2p1", Element::q2p1}});
  options.invariants =
      pick<Invariants>(invariants, "--invariants",
                       {{"isochoric", Invariants::isochoric}, {"plain", Invariants::plain}});
  options.bulk_ratio = bulk_ratio.value_or(0);
  options.wall = parse_wall(wall);
  options.cut = parse_cut(cut);
  options.solver = pick<SolverOption>(solver, "--solver",
                                      {{"auto", SolverOption::automatic},
                                       {"direct", SolverOption::direct},
                                       {"multigrid", SolverOption::multigrid}});
  return options;
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
