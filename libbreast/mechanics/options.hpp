// SPDX-License-Identifier: GPL-3.0-or-later
// The options that all mechanics tools share, and their names on a command line.
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
  /// Whether to seek the smallest change that gives a stable solution where there is none, by about
  /// twenty solves; set to false for searches in which failures are expected.
  bool seek_remedy = true;
};

/// The mechanics options as texts. Where wall, cut or skin is empty, the material set decides.
struct MechanicsTexts {
  std::string materials = "seed2008";  ///< set or file
  std::vector<std::string> scale = {};  ///< "TISSUE=PERCENT"
  std::string element = "q1p0", invariants = "isochoric";
  std::optional<double> bulk_ratio = {};
  std::string wall = {}, cut = {}, solver = "auto";
  std::optional<double> skin_compression = {}, skin_smoothing = {}, skin_prestretch = {};  ///< per cent, -, per cent
};

/// The texts are those of the mechanics options: materials (set or file), "TISSUE=PERCENT" scales,
/// "q1p0" | "q2p1", "isochoric" | "plain", bulk ratio K/μ (none: incompressible), wall and cut as
/// parse_wall and parse_cut read them, "auto" | "direct" | "multigrid". Throws Error (input) for
/// any other.
MechanicsOptions mechanics_options(const MechanicsTexts& texts);

/// The same from the choices of a command line: any struct with members of these names, since the
/// struct of the tools belongs to a layer that this one does not include.
template <class Choices>
MechanicsOptions mechanics_options(const Choices& c) {
  return mechanics_options(MechanicsTexts{c.materials, c.scale, c.element, c.invariants,
                                          c.bulk_ratio, c.wall, c.cut, c.solver,
                                          c.skin_compression, c.skin_smoothing,
                                          c.skin_prestretch});
}

/// Describes the model in one sentence: its boundary conditions, stiffness and skin.
std::string describe_model(const MechanicsOptions& options);

/// The boundary conditions as on a command line: "--wall held --cut free".
std::string support_options(const MechanicsOptions& options);

/// Parses "none", "step" or "q2". Throws Error (input) for any other name.
Estimate estimate_from_name(const std::string& name);
const char* element_name(Element element);
const char* invariants_name(Invariants invariants);

}  // namespace breast
