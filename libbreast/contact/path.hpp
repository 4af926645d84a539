// SPDX-License-Identifier: GPL-3.0-or-later
// Closing the plates: from just touching to a thickness, a force or a mean pressure, in adaptive
// steps with a secant predictor.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact/plates.hpp"
#include "contact/solvers/solver.hpp"
#include "core/progress.hpp"

namespace breast {

enum class TargetKind { thickness, force, pressure, area };

/// Where to stop: thickness between the flats (mm), paddle force (N), paddle force per contact area
/// (kPa), or the paddle's contact area (cm²).
struct CompressionTarget {
  TargetKind kind = TargetKind::thickness;
  double value = 0;
  /// Further places to stop: the path ends at the first of all that it reaches.
  std::vector<CompressionTarget> or_at = {};
};

/// "thickness", "paddle force", "mean pressure" or "contact area".
const char* target_name(TargetKind kind);

/// Lengths in mm of thickness; 0 is a part of the initial thickness.
struct PathOptions {
  double first_step = 0, longest_step = 0, shortest_step = 0.05;
  double least_thickness = 2;    ///< where no thickness is a target, the path gives up here
  double path_tolerance = 1e-4;  ///< residual on the way; the last state is solved to `tolerance`
  double tolerance = 1e-9;
  double control_tolerance = 1e-4;  ///< relative, of force, pressure and area
  int most_solves = 400;
  /// Called before each position is solved, with its thickness (mm), for what else depends on it.
  std::function<void(double)> prepare;
};

/// A converged state of the path.
struct PathPoint {
  double thickness = 0;  ///< mm
  double paddle_N = 0, detector_N = 0, pressure_kPa = 0, area_cm2 = 0;
  int iterations = 0;
};

struct PathResult {
  bool reached = false;
  CompressionTarget met;  ///< which target was reached
  NewtonStop last_failure = NewtonStop::none;  ///< why the path stopped early
  bool solve_limit = false;                    ///< stopped because of PathOptions::most_solves
  /// The path jumps over its target, which is none of thickness: what the quantity is on the two
  /// sides of the jump, in the target's unit.
  std::optional<std::pair<double, double>> jump;
  double failed_thickness = 0;   ///< mm: the step that could not be made
  Eigen::VectorXd failed_trial;  ///< its first refused positions, may be empty
  double thickness = 0;          ///< of the final state
  ContactStep final_step;
  std::vector<PathPoint> points;
  std::vector<NewtonIteration> newton;  ///< all iterations in order
  std::vector<int> newton_step;         ///< the step each belongs to
  int solves = 0, failures = 0, iterations = 0, indefinite = 0;
  std::optional<double> first_indefinite_thickness;  ///< mm; none: never
};

/// Area (mm²) belonging to each node of the deformed skin, for mean pressure along the path.
using NodalArea = std::function<std::vector<double>(const State&)>;

/// Moves the plates from where they stand to the target; `state` ends in the last valid equilibrium
/// and the plates at its thickness. `state` must be in equilibrium at the start or touch nothing.
PathResult follow_path(ContactSolver& solver, PlatePair& plates, State& state,
                       const CompressionTarget& target, const NodalArea& area,
                       const PathOptions& options, Progress& progress = no_progress());

}  // namespace breast
