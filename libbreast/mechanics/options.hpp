// SPDX-License-Identifier: GPL-3.0-or-later
// The options that all mechanics tools share, and their names on a command line.
#pragma once

#include <string>
#include <vector>

#include "core/mechanics_texts.hpp"
#include "material/material_set.hpp"
#include "mechanics/supports/support.hpp"
#include "surface/level_surface.hpp"

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
  /// Springs of supports are at rest in the stress-free shape.
  SupportPtr wall = default_support(SupportPlace::wall), cut = default_support(SupportPlace::cut);
  /// The surface of the chest wall; null: that of the mesh's geometry.
  std::shared_ptr<const LevelSurface> wall_surface = nullptr;
  SolverOption solver = SolverOption::automatic;
  Estimate estimate = Estimate::none;
  /// Whether to seek the smallest change that gives a stable solution where there is none, by about
  /// twenty solves; set to false for searches in which failures are expected.
  bool seek_remedy = true;
};

/// The supports of wall and cut with which the material set of the options was identified; unchanged
/// where the set has none. Throws Error (input) for a text that stands for no support.
void take_supports_of_set(MechanicsOptions& options);
/// The material set of these options with their supports in place of its own.
MaterialSet set_with_supports(const MechanicsOptions& options);

/// The parameters by which a model may be scaled (material/set_parameter.hpp): those that name constants
/// of its laws, and those of its supports; without "stiffness", which is low_order and quadratic together.
std::vector<std::string> model_parameters(const MechanicsOptions& options);
/// Multiplies what a parameter names, "stiffness" included. Throws Error (input) if the model does not
/// have it.
void scale_model(MechanicsOptions& options, const std::string& parameter, double factor);

/// `model` with what the texts give: materials (a set or a file, with its laws, densities and skin,
/// and with those supports of wall and cut that it has), then "TISSUE=PERCENT" scales of these
/// materials, "q1p0" | "q2p1", "isochoric" | "plain", the bulk ratio as parse_bulk_ratio reads it,
/// wall and cut as read_support reads them, and the skin; and the solver "auto" | "direct" |
/// "multigrid". A cut that carries the tissue beyond it keeps only its springs where the wall that is
/// given has none. Throws Error (input) for any other text, and if there is no material set at all.
MechanicsOptions mechanics_options(const MechanicsTexts& texts, MechanicsOptions model = {});

/// "incompressible" (0) or a ratio of bulk to shear modulus from 1 to 1e9. Throws Error (input) for
/// anything else.
double parse_bulk_ratio(const std::string& text);
/// The text that parse_bulk_ratio reads as this ratio.
std::string bulk_ratio_text(double ratio);

/// Describes the model in one sentence: its boundary conditions, stiffness and skin.
std::string describe_model(const MechanicsOptions& options);

/// Parses "none", "step" or "q2". Throws Error (input) for any other name.
Estimate estimate_from_name(const std::string& name);
const char* element_name(Element element);
const char* invariants_name(Invariants invariants);

}  // namespace breast
