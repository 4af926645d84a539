// SPDX-License-Identifier: GPL-3.0-or-later
// The MECHANICS options every mechanics tool shares, and their names on a command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "material/law.hpp"
#include "mechanics/wall_option.hpp"

namespace breast {

enum class Element { q1p0, q2p1 };
enum class Invariants { isochoric, plain };
/// How the discretisation error of 8-node elements is estimated: not at all, by two steps with
/// 27-node elements and one matrix (mechanics/estimate/error_estimate.hpp), or by solving once more with
/// them (mechanics/estimate/second_solution.hpp).
enum class Estimate { none, step, q2 };
/// The linear solver; automatic: see mechanics/chosen_solver.hpp.
enum class SolverOption { automatic, direct, multigrid };

struct MechanicsOptions {
  MaterialSet materials;
  Element element = Element::q1p0;
  Invariants invariants = Invariants::isochoric;
  double bulk_ratio = 0;  ///< K/μ; 0 means exactly incompressible
  WallOption wall = {};  ///< springs are at rest in the stress-free shape
  CutOption cut = {};
  SolverOption solver = SolverOption::automatic;
  Estimate estimate = Estimate::none;
  /// Without a stable answer the smallest change that gives one is sought, by some twenty solves: not
  /// for searches that expect failures.
  bool seek_remedy = true;
};

/// The MECHANICS options as texts. Empty: what the material set says of wall, cut and skin.
struct MechanicsTexts {
  std::string materials = "seed2008";  ///< set or file
  std::vector<std::string> scale = {};  ///< "TISSUE=PERCENT"
  std::string element = "q1p0", invariants = "isochoric";
  std::optional<double> bulk_ratio = {};
  std::string wall = {}, cut = {}, solver = "auto";
  std::optional<double> skin_compression = {}, skin_smoothing = {}, skin_prestretch = {};  ///< per cent, -, per cent
};

/// Names are those of the MECHANICS options: materials (set or file), "TISSUE=PERCENT" scales,
/// "q1p0" | "q2p1", "isochoric" | "plain", bulk ratio K/μ (none: incompressible), wall and cut as
/// parse_wall and parse_cut read them, "auto" | "direct" | "multigrid". Throws Error (input) for any other.
MechanicsOptions mechanics_options(const MechanicsTexts& texts);

/// The same from a command line's choices: a struct with members of these names, which belongs to a
/// layer this one does not include.
template <class Choices>
MechanicsOptions mechanics_options(const Choices& c) {
  return mechanics_options(MechanicsTexts{c.materials, c.scale, c.element, c.invariants,
                                          c.bulk_ratio, c.wall, c.cut, c.solver,
                                          c.skin_compression, c.skin_smoothing,
                                          c.skin_prestretch});
}

/// Which model of a breast this is, in one sentence: what holds it, how soft it is, what its skin does.
std::string describe_model(const MechanicsOptions& options);

/// What holds the breast, as on a command line: "--wall held --cut free".
std::string support_options(const MechanicsOptions& options);

/// "none" | "step" | "q2". Throws Error (input) for any other.
Estimate estimate_from_name(const std::string& name);
const char* element_name(Element element);
const char* invariants_name(Invariants invariants);

}  // namespace breast
