// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "contact/path/next_position.hpp"
#include "contact/path/path_point.hpp"
#include "contact/path/waypoint.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

/// Steps longer than this fraction of the longest are abandoned if they begin badly.
constexpr double fast_part = 0.3;

/// Largest residual of the states among which a force, pressure or area is sought: with faces as deep
/// in the plates as on the way, they would differ by several per cent.
constexpr double sought_tolerance = 1e-6;

/// Plate positions closer than this count as equal, mm.
constexpr double narrowest_bracket = 1e-4;

/// A position that took fewer iterations than `quick`, corrections aside, lengthens the next step;
/// one that took more than `slow` shortens it.
constexpr int quick = 8, slow = 12;

/// States kept for a return when the last one turns out not to be an equilibrium.
constexpr std::size_t longest_trail = 3;

class Path {
 public:
  Path(ContactSolver& solver, PlatePair& plates, const CompressionTarget& target,
       const PaddleArea& area, const PathOptions& options, Progress& progress)
      : solver_(solver),
        plates_(plates),
        stops_{thickness_in(target), others_than_thickness(target), options.corners},
        area_(area),
        options_(options),
        progress_(progress),
        start_thickness_(plates.thickness()),
        tolerance_(options.path_tolerance) {}

  PathResult run(State& state);

 private:
  const CompressionTarget* passed(const PathPoint& point) const;
  double longest_step() const;
  double sought() const { return std::min(tolerance_, sought_tolerance); }
  bool march();
  bool end_at(const CompressionTarget& target, Waypoint reached);
  bool end_at_thickness();
  bool sharpen_before(const CompressionTarget& target, Waypoint& high);
  bool refine_control(const CompressionTarget& target, Waypoint high);
  bool attempt(const Guess& guess, double thickness, double tolerance, Waypoint& reached);
  bool sharpen(double tolerance, Waypoint& sharp);
  bool finish();
  bool step_back();
  bool be_patient();
  void tell(const PathPoint& point) const;

  ContactSolver& solver_;
  PlatePair& plates_;
  PathStops stops_;
  const PaddleArea& area_;
  const PathOptions& options_;
  Progress& progress_;
  double start_thickness_;
  double tolerance_;  ///< tolerance of intermediate positions
  PathResult result_;
  Waypoint start_, here_, before_;
  bool have_before_ = false;
  bool patient_ = false;                 ///< solves positions that begin badly to the end
  std::optional<Waypoint> first_haste_;  ///< the state before the first position that was abandoned
  std::deque<Waypoint> trail_;           ///< the states before before_
};

/// Of the targets passed at a point, the one passed by the most; null before all of them.
const CompressionTarget* Path::passed(const PathPoint& point) const {
  const CompressionTarget* furthest = nullptr;
  double most = 1 + options_.control_tolerance;
  for (const CompressionTarget& control : stops_.controls) {
    const double part = measure(point, control.kind) / control.value;
    if (part >= most) most = part, furthest = &control;
  }
  return furthest;
}

void Path::tell(const PathPoint& point) const {
  double fraction = -1;
  if (stops_.end && start_thickness_ != *stops_.end)
    fraction = (start_thickness_ - point.thickness) / (start_thickness_ - *stops_.end);
  for (const CompressionTarget& control : stops_.controls)
    fraction = std::max(fraction, std::min(1.0, measure(point, control.kind) / control.value));
  progress_.update(
      "compress", fraction,
      message("thickness ", std::round(10 * point.thickness) / 10, " mm, paddle ",
              std::round(10 * point.paddle_N) / 10, " N, detector ",
              std::round(10 * point.detector_N) / 10, " N, ", point.iterations, " iterations"));
}

bool Path::attempt(const Guess& guess, double thickness, double tolerance, Waypoint& reached) {
  plates_.close_to(thickness);
  if (options_.prepare) options_.prepare(thickness);
  State state = guess.state;
  solver_.restore(guess.memory);
  ContactStep step = solver_.solve(plates_, state, tolerance);
  ++result_.solves;
  result_.iterations += int(step.iterations.size());
  result_.indefinite += step.indefinite;
  if (step.indefinite > 0 && !result_.first_indefinite_thickness) {
    result_.first_indefinite_thickness = thickness;
  }
  for (const NewtonIteration& record : step.iterations) {
    result_.newton.push_back(record);
    result_.newton_step.push_back(result_.solves);
  }
  if (!step.converged) {
    ++result_.failures;
    if (step.hurried && !first_haste_) first_haste_ = here_;
    result_.last_failure = step.stop;
    result_.failed_thickness = thickness;
    result_.failed_trial = step.failed_trial;
    return false;
  }
  PathPoint point = path_point(solver_, plates_, state, step, area_(state));
  point.thickness = thickness;  // to the last digit, as the path compares it
  tell(point);
  State moved = step.softer.value_or(state);
  result_.final_step = std::move(step);
  reached = {std::move(state), solver_.memory(), thickness, point, std::move(moved)};
  result_.points.push_back(point);
  return true;
}

/// From the present position, mm.
double Path::longest_step() const {
  if (options_.longest_step > 0) return options_.longest_step;
  const bool slipping =
      here_.thickness <= options_.slipping_below && here_.thickness > options_.slipping_above;
  const double part = slipping ? std::min(options_.slipping_part, options_.longest_part)
                               : options_.longest_part;
  return part * plates_.initial_thickness;
}

bool Path::march() {
  double step = options_.first_step > 0 ? options_.first_step : longest_step();
  int failures_in_row = 0;
  result_.jump.reset();
  while (result_.solves < options_.most_solves) {
    if (stops_.end && here_.thickness == *stops_.end) return end_at_thickness();
    const double longest = longest_step();
    step = std::min(step, longest);
    const double thickness = next_thickness(
        step, here_.point, have_before_ ? &before_.point : nullptr, stops_);
    if (!stops_.end && !(thickness > options_.least_thickness)) {
      result_.failed_thickness = thickness;
      result_.last_failure = NewtonStop::none;
      return false;
    }
    // After two refusals in a row, the extrapolation itself may be the reason why elements fold.
    const bool straight_on = have_before_ && failures_in_row % 3 != 2;
    const Guess guess = extrapolate(here_, straight_on ? &before_ : nullptr, thickness);
    Waypoint reached;
    const bool fail_fast = !patient_ && std::abs(thickness - here_.thickness) > fast_part * longest;
    solver_.set_fail_fast(fail_fast);
    const bool arrived = attempt(guess, thickness, tolerance_, reached);
    solver_.set_fail_fast(false);
    if (arrived) {
      const int iterations =
          int(result_.final_step.iterations.size()) - result_.final_step.corrections;
      // A length that was just found by halving is used twice before it grows again.
      if (iterations < quick && failures_in_row == 0) step = std::min(longest, 1.4 * step);
      if (iterations > slow) step = std::max(options_.shortest_step, 0.7 * step);
      failures_in_row = 0;
      const bool may_end = !options_.may_end || options_.may_end(thickness);
      if (const CompressionTarget* target = may_end ? passed(reached.point) : nullptr) {
        return end_at(*target, std::move(reached));
      }
      trail_.push_back(std::move(before_));
      if (trail_.size() > longest_trail) trail_.pop_front();
      before_ = std::move(here_);
      here_ = std::move(reached);
      have_before_ = true;
    } else {
      ++failures_in_row;
      step = 0.5 * std::min(step, std::abs(thickness - here_.thickness));
      if (step < options_.shortest_step) {
        if (!be_patient()) return false;
        step = longest;
        failures_in_row = 0;
      }
    }
  }
  result_.solve_limit = true;
  return false;
}

/// Refines the end between the last state and one beyond the target; takes the latter if the path
/// could not end earlier.
bool Path::end_at(const CompressionTarget& target, Waypoint reached) {
  if (sharpen_before(target, reached)) return refine_control(target, std::move(reached));
  result_.met = target;
  result_.passed_by = measure(reached.point, target.kind);
  before_ = std::move(here_);
  here_ = std::move(reached);
  return true;
}

/// Solves the last state again, to this residual.
bool Path::sharpen(double tolerance, Waypoint& sharp) {
  if (!attempt({here_.state, here_.memory}, here_.thickness, tolerance, sharp)) return false;
  drop_repeated_point(result_.points);
  return true;
}

/// Ends at the last state, unless its accurate solution lies beyond another target.
bool Path::end_at_thickness() {
  Waypoint sharp;
  if (!stops_.controls.empty() && sharpen(sought(), sharp)) {
    const CompressionTarget* target = passed(sharp.point);
    if (target != nullptr && step_back()) return end_at(*target, std::move(sharp));
    here_ = std::move(sharp);
  }
  result_.met = {TargetKind::thickness, *stops_.end};
  return true;
}

/// Solves the last state accurately, and those before it until one lies before the target; `high`
/// becomes the first accurate one beyond it. Returns false if there is none before the target at
/// which the path may end.
bool Path::sharpen_before(const CompressionTarget& target, Waypoint& high) {
  const auto may_end_here = [&] {
    return (!options_.may_end || options_.may_end(here_.thickness)) &&
           measure(here_.point, target.kind) < target.value;
  };
  while (may_end_here()) {
    Waypoint sharp;
    if (!sharpen(sought(), sharp)) return true;
    if (measure(sharp.point, target.kind) < target.value) {
      here_ = std::move(sharp);
      return true;
    }
    high = std::move(sharp);
    if (!step_back()) return false;
  }
  return false;
}

/// Bracketed secant method (Illinois) on the thickness between a state before the target and one
/// beyond it; interpolated initial states keep each solve short. A state that then lies beyond
/// another target moves the end to that target.
bool Path::refine_control(const CompressionTarget& target, Waypoint high) {
  Waypoint low = here_;
  const auto beyond = [&](const Waypoint& w) {
    return measure(w.point, target.kind) - target.value;
  };
  double f_low = beyond(low), f_high = beyond(high);
  for (int k = 0; k < 40; ++k) {
    const Waypoint& best = std::abs(beyond(high)) < std::abs(beyond(low)) ? high : low;
    const bool met = std::abs(beyond(best)) <= options_.control_tolerance * target.value;
    if (met || std::abs(low.thickness - high.thickness) < narrowest_bracket) {
      const CompressionTarget* other = passed(best.point);
      if (met && other != nullptr && other != &target) {
        const Waypoint from = best;
        return refine_control(*other, from);
      }
      // The positions are equal, with the target between them: a point comes into contact, so that
      // only the area changes, or the body snaps through, which is said.
      const double force = std::abs(low.point.paddle_N - high.point.paddle_N);
      if (!met && force > options_.control_tolerance * best.point.paddle_N)
        result_.jump = {measure(low.point, target.kind), measure(high.point, target.kind)};
      result_.met = target;
      before_ = low;
      here_ = best;
      return true;
    }
    const double w = f_low / (f_low - f_high);
    const double thickness = low.thickness + w * (high.thickness - low.thickness);
    const State between{low.state.reference, (1 - w) * low.state.x + w * high.state.x,
                        (1 - w) * low.state.p + w * high.state.p};
    Waypoint middle;
    // The memory of a state beyond the target is not used, because friction would keep it.
    if (!attempt({between, low.memory}, thickness, sought(), middle)) {
      here_ = low;
      return false;
    }
    const double f = beyond(middle);
    if (f < 0) {
      low = std::move(middle);
      f_low = f;
      f_high *= 0.5;
    } else {
      high = std::move(middle);
      f_high = f;
      f_low *= 0.5;
    }
  }
  here_ = low;
  return false;
}

/// Returns to the previous waypoint; false if the path is at its start.
bool Path::step_back() {
  if (have_before_) {
    here_ = std::move(before_);
  } else if (here_.thickness != start_.thickness) {
    here_ = start_;
  } else {
    return false;
  }
  drop_points_beyond(here_.thickness, result_.points);
  have_before_ = !trail_.empty() && trail_.back().state.x.size() > 0;
  if (have_before_) {
    before_ = std::move(trail_.back());
    trail_.pop_back();
  }
  return true;
}

/// Returns, once, to where abandoning a position first changed the path: short steps may follow a
/// branch that ends where a long step passes to the next branch.
bool Path::be_patient() {
  if (patient_ || !first_haste_) return false;
  patient_ = true;
  here_ = *first_haste_;
  have_before_ = false;
  trail_.clear();
  drop_points_beyond(here_.thickness, result_.points);
  return true;
}

/// Solves the last state accurately. Close to where a path ends or slips, a loosely solved state
/// may not be an equilibrium: then returns false, and here_ is the last waypoint with an accurate
/// solution; if there is none, no points are left.
bool Path::finish() {
  for (bool last = true;; last = false) {
    Waypoint sharp;
    if (sharpen(options_.tolerance, sharp)) {
      here_ = std::move(sharp);
      return last;
    }
    if (!step_back()) {
      result_.points.clear();
      return false;
    }
  }
}

PathResult Path::run(State& state) {
  here_ = {state, solver_.memory(), plates_.thickness(), {}, state};
  // The state from which the plates start: without contact, or the end of an earlier path.
  Waypoint first;
  if (attempt({state, here_.memory}, here_.thickness, options_.path_tolerance, first)) {
    start_ = here_ = std::move(first);
    result_.reached = march();
    if (!finish() && !result_.points.empty()) {
      // The loosely solved states were misleading: repeats the path with accurate solves.
      tolerance_ = options_.tolerance;
      result_.reached = march();
      if (!finish()) result_.reached = false;
    }
  }
  if (result_.points.empty()) result_.reached = false;
  if (result_.reached) result_.failed_trial.resize(0);
  plates_.close_to(here_.thickness);
  solver_.restore(here_.memory);
  result_.thickness = here_.thickness;
  state = std::move(here_.state);
  return std::move(result_);
}

}  // namespace

PathResult follow_path(ContactSolver& solver, PlatePair& plates, State& state,
                       const CompressionTarget& target, const PaddleArea& area,
                       const PathOptions& options, Progress& progress) {
  return Path(solver, plates, target, area, options, progress).run(state);
}

}  // namespace breast
