// SPDX-License-Identifier: GPL-3.0-or-later
// Closing of the plates from first contact to a thickness, a force or a mean pressure, in adaptive
// steps with a secant predictor.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/path/target.hpp"
#include "contact/path/waypoint.hpp"
#include "contact/plates.hpp"
#include "contact/solvers/solver.hpp"
#include "core/progress.hpp"

namespace breast {

/// Step lengths are in mm of thickness; 0 chooses `longest_part` of the initial thickness.
struct PathOptions {
  double first_step = 0, longest_step = 0, shortest_step = 0.05;
  double longest_part = 0.07;  ///< about 7 mm for a typical breast
  /// The longest step (a fraction, like `longest_part`, and never more than that) between these parts
  /// of the way. There the breast slips on the plates, and within a step it slips along straight
  /// lines.
  double slipping_part = 0.07, slipping_from = 0, slipping_to = 0;
  double least_thickness = 2;    ///< smallest thickness of a path without a thickness as target, mm
  double path_tolerance = 3e-4;  ///< residual of intermediate states; the final state is solved to
                                 ///< `tolerance`
  double tolerance = 1e-9;
  double control_tolerance = 1e-4;  ///< relative, of force, pressure and area
  int most_solves = 400;
  /// No step begins after so many iterations of Newton's method. Views of real women that the plates grip took 160 to 1076; this
  /// is three times the mean of CC views. The last step may go beyond.
  int most_iterations = 1200;
  /// Called before each position is solved with the part of the way to the nearest target (0 to 1) at
  /// which it is expected, to update whatever depends on it.
  std::function<void(double)> prepare;
  /// Parts of the way near which a closing path stops, because the load that `prepare` sets has a
  /// corner there.
  std::vector<double> corners;
  /// A target other than a thickness may end the path from this part of the way on.
  double may_end_from = 0;
  /// Returns the weight (N, along the beam, positive towards the detector) that no hand carries at a
  /// part of the way. If it is given, the plates' mid-plane follows the breast (mid_plane_move).
  std::function<double(double)> weight_N;
  /// A path that passes a target other than a thickness ends there, unfinished, if more than this part of a plate's force lies
  /// on its rounded edge: the plates are then placed elsewhere, and the exact end (ClosingPath::finish) is sought only if no
  /// other place is better.
  double most_on_edge = std::numeric_limits<double>::infinity();
  /// Whether PathResult::kept is filled.
  bool keep = false;
};

/// Why a path ended.
enum class PathEnd {
  target,          ///< a target was reached
  solve_limit,     ///< PathOptions::most_solves positions were solved
  cost_limit,      ///< PathOptions::most_iterations iterations were made
  on_edge,         ///< a target was passed, with more on an edge than PathOptions::most_on_edge
  out_of_reach,    ///< the plates would have to close to less than PathOptions::least_thickness
  no_equilibrium,  ///< even the shortest step fails: PathResult::last_failure says why
};

struct PathResult {
  PathEnd end = PathEnd::no_equilibrium;
  bool reached() const { return end == PathEnd::target; }
  CompressionTarget met;  ///< which target was reached
  /// Set if the target was passed where the path may not end: the quantity at the end, in the unit
  /// of the target.
  std::optional<double> passed_by;
  /// If the path snaps through past a target that is not a thickness: the quantity on both sides of
  /// the snap-through, in the target's unit.
  std::optional<std::pair<double, double>> jump;
  NewtonStop last_failure = NewtonStop::none;  ///< of the last position without a solution
  double failed_thickness = 0;                 ///< mm, of that position, or of one out of reach
  Eigen::VectorXd failed_trial;  ///< positions of its first rejected trial, may be empty
  double thickness = 0;          ///< of the final state
  double way = 0;                ///< the part of the way for which its load was set
  ContactStep final_step;
  std::vector<PathPoint> points;        ///< none if there is no equilibrium at the first position
  std::vector<NewtonIteration> newton;  ///< all iterations, in order
  std::vector<int> newton_step;         ///< the step each belongs to
  int solves = 0, failures = 0, iterations = 0, indefinite = 0;
  std::optional<double> first_indefinite_thickness;  ///< mm; absent if the tangent was never
                                                     ///< indefinite
  /// The positions from the first to the final one, in order of decreasing thickness, if asked for.
  std::vector<Waypoint> kept;
};

/// Returns the area (mm²) over which a state touches the paddle where it stands, for the mean pressure
/// along the path.
using PaddleArea = std::function<double(const State&)>;

/// The way of a pair of plates to a target. `solver`, `plates` and `progress` must outlive this object.
class ClosingPath {
 public:
  ClosingPath(ContactSolver& solver, PlatePair& plates, const CompressionTarget& target,
              PaddleArea area, PathOptions options, Progress& progress = no_progress());
  ~ClosingPath();
  ClosingPath(const ClosingPath&) = delete;
  ClosingPath& operator=(const ClosingPath&) = delete;

  /// Moves the plates from their present position to the target; `state` ends as the last valid
  /// equilibrium, with the plates at its thickness. Initially `state` must be in equilibrium or touch
  /// nothing.
  PathResult follow(State& state);
  /// After PathEnd::on_edge: seeks the exact end, as if PathOptions::most_on_edge were infinite. The result is that of the
  /// whole path. Solver and plates must not have been used in between. `iterations_left` replaces what PathOptions::most_iterations
  /// leaves; the exact end is sought in any case.
  PathResult finish(State& state, int iterations_left);

 private:
  class Way;
  std::unique_ptr<Way> way_;
};

/// ClosingPath::follow.
PathResult follow_path(ContactSolver& solver, PlatePair& plates, State& state,
                       const CompressionTarget& target, const PaddleArea& area,
                       const PathOptions& options, Progress& progress = no_progress());

}  // namespace breast
