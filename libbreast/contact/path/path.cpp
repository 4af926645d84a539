// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way of the plates, from ClosingPath::Way::follow downwards:
//
//   close_plates   steps until a target is passed, on loosely solved states (path_tolerance)
//     try_step       one position; a step that fails is halved, one that is easy is lengthened
//     end_at         the position at which the target is met exactly: search_end in a Bracket
//   settle         the last state solved to the tolerance; where it then is no equilibrium, the one
//                  before it
//
// If settle had to go back, the loosely solved states were misleading, and the rest of the way is
// repeated with all states solved to the tolerance.
#include "contact/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/path/mid_plane.hpp"
#include "contact/path/step_length.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

/// Largest residual of the states among which a force, pressure or area is sought: with faces as deep
/// in the plates as on the way, they would differ by several per cent.
constexpr double sought_tolerance = 1e-6;

/// Plate positions closer than this count as equal, mm.
constexpr double narrowest_bracket = 1e-4;
constexpr int most_in_bracket = 40;  ///< positions at which one end is sought
/// A position in a bracket at which no equilibrium is found is approached this often by half the way.
constexpr int most_halvings_in_bracket = 4;

/// Two states with a target between them. The thickness at which it is met is sought by the secant
/// through both, where the weight of an end that stays is halved (Illinois method).
class Bracket {
 public:
  Bracket(Waypoint before, Waypoint beyond, const CompressionTarget& target)
      : target_(target), low_(std::move(before)), high_(std::move(beyond)) {
    low_weight_ = excess(low_);
    high_weight_ = excess(high_);
  }

  const Waypoint& low() const { return low_; }
  const Waypoint& high() const { return high_; }
  /// The state nearer to the target.
  const Waypoint& best() const {
    return std::abs(excess(high_)) < std::abs(excess(low_)) ? high_ : low_;
  }
  bool meets_target(double relative) const {
    return std::abs(excess(best())) <= relative * target_.value;
  }
  bool is_narrow() const { return std::abs(low_.thickness - high_.thickness) < narrowest_bracket; }
  double thickness() const { return low_.thickness + part() * (high_.thickness - low_.thickness); }
  /// Interpolated states keep each solve short. The memory of a state beyond the target is not used,
  /// because friction would keep it.
  Guess guess_at(double thickness) const { return interpolate(low_, high_, thickness); }
  void shrink_to(Waypoint middle) {
    const double there = excess(middle);
    if (there < 0) {
      low_ = std::move(middle);
      low_weight_ = there;
      high_weight_ *= 0.5;
    } else {
      high_ = std::move(middle);
      high_weight_ = there;
      low_weight_ *= 0.5;
    }
  }

 private:
  double excess(const Waypoint& at) const { return measure(at.point, target_) - target_.value; }
  double part() const { return low_weight_ / (low_weight_ - high_weight_); }

  CompressionTarget target_;
  Waypoint low_, high_;
  double low_weight_ = 0, high_weight_ = 0;
};

}  // namespace

class ClosingPath::Way {
 public:
  Way(ContactSolver& solver, PlatePair& plates, const CompressionTarget& target, PaddleArea area,
      PathOptions options, Progress& progress)
      : solver_(solver),
        plates_(plates),
        target_(target),
        stops_{thickness_in(target), others_than_thickness(target), {}, {}},
        area_(std::move(area)),
        options_(std::move(options)),
        progress_(progress),
        start_thickness_(plates.thickness()),
        tolerance_(options_.path_tolerance) {
    add_corners();
  }

  PathResult follow(State& state);
  PathResult finish(State& state, int iterations_left);

 private:
  // The way.
  void settle_or_repeat();
  void add_corners();
  bool solve_start(const State& state);
  PathEnd close_plates();
  std::optional<Waypoint> try_step(double thickness, const StepLength& step);
  bool go_back_with_patience();
  std::optional<Waypoint> let_go_at(const Waypoint& reached);
  bool settle();
  PathResult conclude(State& state);

  // The end of the way.
  const CompressionTarget* passed(const PathPoint& point) const;
  PathEnd end_at_thickness();
  PathEnd end_at(const CompressionTarget& target, Waypoint beyond);
  bool sharpen_up_to(const CompressionTarget& target, Waypoint& beyond);
  bool let_go_before(const CompressionTarget& target, Waypoint& beyond);
  PathEnd search_end(const CompressionTarget& target, Waypoint beyond);
  std::optional<Waypoint> solve_within(const Bracket& bracket);
  PathEnd end_in(const Bracket& bracket, const CompressionTarget& target);

  // One position.
  std::optional<Waypoint> solve_at(double thickness, const Guess& guess, double way,
                                   double tolerance);
  std::optional<Waypoint> sharpened(double tolerance);
  std::optional<Waypoint> solve_again(double way, double tolerance);
  void record_iterations(const ContactStep& step, double thickness);
  void record_failure(const ContactStep& step, double thickness);
  bool step_back();
  void drop_points_beyond_here();
  void tell(const PathPoint& point) const;
  void keep(const Waypoint& at);

  double longest_step() const;
  double sought() const { return std::min(tolerance_, sought_tolerance); }
  double expected_way(double thickness) const;
  bool may_end(const Waypoint& at) const { return at.way >= options_.may_end_from - same_part; }
  bool out_of_reach(double thickness) const {
    return !stops_.end && !(thickness > options_.least_thickness);
  }

  ContactSolver& solver_;
  PlatePair& plates_;
  CompressionTarget target_;
  PathStops stops_;
  PaddleArea area_;
  PathOptions options_;
  Progress& progress_;
  double start_thickness_;
  double tolerance_;  // of the states on the way
  Trail trail_;
  bool patient_ = false;                 // solves positions that begin badly to the end
  std::optional<Waypoint> first_haste_;  // the state before the first position that was abandoned
  PathResult result_;
};

PathResult ClosingPath::Way::follow(State& state) {
  if (solve_start(state)) {
    result_.end = close_plates();
    if (result_.end != PathEnd::on_edge) settle_or_repeat();
  }
  return conclude(state);
}

PathResult ClosingPath::Way::finish(State& state, int iterations_left) {
  options_.most_iterations = result_.iterations + iterations_left;
  options_.most_on_edge = std::numeric_limits<double>::infinity();
  Waypoint beyond = trail_.here();
  const CompressionTarget* target = passed(beyond.point);
  trail_.step_back();
  result_.end = end_at(*target, std::move(beyond));
  settle_or_repeat();
  return conclude(state);
}

/// The last state accurately; if that shows that the loosely solved states were misleading, the way from
/// the last accurate one on.
void ClosingPath::Way::settle_or_repeat() {
  if (settle() || result_.points.empty()) return;
  tolerance_ = options_.tolerance;
  result_.end = close_plates();
  if (!settle()) result_.end = PathEnd::no_equilibrium;
}

/// A corner lies on the way of the thickness, and on that of each control.
void ClosingPath::Way::add_corners() {
  for (const double way : options_.corners) {
    if (stops_.end) {
      const double initial = plates_.closing_range;
      stops_.corners.push_back(initial + closing_at(way, target_) * (*stops_.end - initial));
    }
    for (CompressionTarget control : stops_.controls) {
      control.value *= way;
      stops_.corner_controls.push_back(control);
    }
  }
}

/// The state from which the plates start: without contact, or the end of an earlier path. The trail
/// begins at `state` itself, where the path ends if there is no equilibrium at its first position.
bool ClosingPath::Way::solve_start(const State& state) {
  trail_.begin({state, solver_.memory(), plates_.thickness(), {}, 0, plates_.moved, state});
  std::optional<Waypoint> start = solve_at(
      plates_.thickness(), {state, solver_.memory(), plates_.moved}, 0, options_.path_tolerance);
  if (!start) return false;
  keep(*start);
  trail_.begin(std::move(*start));
  return true;
}

/// Closes the plates step by step, until a target is passed or no step is possible any more.
PathEnd ClosingPath::Way::close_plates() {
  StepLength step(options_.first_step > 0 ? options_.first_step : longest_step(),
                  options_.shortest_step);
  result_.jump.reset();
  while (result_.solves < options_.most_solves) {
    if (result_.iterations >= options_.most_iterations) return PathEnd::cost_limit;
    const Waypoint& here = trail_.here();
    if (stops_.end && here.thickness == *stops_.end) return end_at_thickness();
    step.limit(longest_step());
    const PathPoint* before = trail_.before() != nullptr ? &trail_.before()->point : nullptr;
    const double thickness = next_thickness(step.mm(), here.point, before, stops_);
    if (out_of_reach(thickness)) {
      result_.failed_thickness = thickness;
      return PathEnd::out_of_reach;
    }
    std::optional<Waypoint> reached = try_step(thickness, step);
    if (!reached) {
      if (step.halve(std::abs(thickness - here.thickness))) continue;
      if (!go_back_with_patience()) return PathEnd::no_equilibrium;
      step.restart();
      continue;
    }
    step.adapt(int(result_.final_step.iterations.size()) - result_.final_step.corrections);
    // The end is sought between two states of the same load: a step that passes a target while the load
    // still changes is made shorter, or, if it is the shortest, ends with the load of the end.
    if (passed(reached->point) != nullptr && !(may_end(here) && may_end(*reached))) {
      drop_points_beyond_here();
      if (step.halve(std::abs(thickness - here.thickness))) continue;
      if (std::optional<Waypoint> free = let_go_at(*reached)) {
        reached = std::move(free);
      } else {
        result_.points.push_back(reached->point);
      }
    }
    const CompressionTarget* target = may_end(*reached) ? passed(reached->point) : nullptr;
    if (target != nullptr && largest_edge_part(reached->point) <= options_.most_on_edge)
      return end_at(*target, std::move(*reached));
    keep(*reached);
    trail_.advance(std::move(*reached));
    if (target != nullptr) return PathEnd::on_edge;
  }
  return PathEnd::solve_limit;
}

std::optional<Waypoint> ClosingPath::Way::try_step(double thickness, const StepLength& step) {
  const Waypoint& here = trail_.here();
  Guess guess =
      extrapolate(here, step.distrusts_extrapolation() ? nullptr : trail_.before(), thickness);
  if (options_.weight_N) {
    guess.plates_moved +=
        mid_plane_move(here.point, here.thickness - thickness, options_.weight_N(here.way));
  }
  solver_.set_fail_fast(!patient_ && step.may_fail_fast(std::abs(thickness - here.thickness)));
  std::optional<Waypoint> reached = solve_at(thickness, guess, expected_way(thickness), tolerance_);
  solver_.set_fail_fast(false);
  return reached;
}

/// Where even the shortest step passes a target before the path may end: the same position with the
/// load of the end of the way.
std::optional<Waypoint> ClosingPath::Way::let_go_at(const Waypoint& reached) {
  return solve_at(reached.thickness, {reached.state, reached.memory, reached.plates_moved},
                  std::max(reached.way, options_.may_end_from), tolerance_);
}

/// The part of the way at which a position is expected. It never decreases.
double ClosingPath::Way::expected_way(double thickness) const {
  if (!options_.prepare) return 0;
  const Waypoint& here = trail_.here();
  const PathPoint* before = trail_.before() != nullptr ? &trail_.before()->point : nullptr;
  return std::max(here.way, expected_part_of_way(thickness, here.point, before, target_,
                                                 plates_.closing_range));
}

/// Returns, once, to where abandoning a position first changed the path: short steps may follow a
/// branch that ends where a long step passes to the next branch.
bool ClosingPath::Way::go_back_with_patience() {
  if (patient_ || !first_haste_) return false;
  patient_ = true;
  trail_.restart_at(*first_haste_);
  drop_points_beyond_here();
  return true;
}

/// Solves the last state accurately. Close to where a path ends or slips, a loosely solved state
/// may not be an equilibrium: then returns false, and the path ends at the last state with an
/// accurate solution; if there is none, no points are left.
bool ClosingPath::Way::settle() {
  for (bool last = true;; last = false) {
    if (std::optional<Waypoint> sharp = sharpened(options_.tolerance)) {
      trail_.sharpen(std::move(*sharp));
      return last;
    }
    if (!step_back()) {
      result_.points.clear();
      return false;
    }
  }
}

PathResult ClosingPath::Way::conclude(State& state) {
  if (result_.points.empty()) result_.end = PathEnd::no_equilibrium;
  if (result_.reached()) result_.failed_trial.resize(0);
  const Waypoint& here = trail_.here();
  keep(here);
  plates_.moved = here.plates_moved;
  plates_.close_to(here.thickness);
  solver_.restore(here.memory);
  result_.thickness = here.thickness;
  result_.way = here.way;
  state = here.state;
  return result_;
}

/// Of the targets passed at a point, the one passed by the most; null before all of them.
const CompressionTarget* ClosingPath::Way::passed(const PathPoint& point) const {
  const CompressionTarget* furthest = nullptr;
  double most = 1 + options_.control_tolerance;
  for (const CompressionTarget& control : stops_.controls) {
    const double part = measure(point, control) / control.value;
    if (part >= most) most = part, furthest = &control;
  }
  return furthest;
}

/// Ends at the last state, unless its accurate solution lies beyond another target.
PathEnd ClosingPath::Way::end_at_thickness() {
  std::optional<Waypoint> sharp;
  if (!stops_.controls.empty()) sharp = sharpened(sought());
  if (sharp) {
    const CompressionTarget* target = passed(sharp->point);
    if (target != nullptr && step_back()) return end_at(*target, std::move(*sharp));
    trail_.sharpen(std::move(*sharp));
  }
  result_.met = {TargetKind::thickness, *stops_.end};
  return PathEnd::target;
}

/// Seeks the end between the last state and one beyond the target; takes the latter if the path
/// could not end earlier.
PathEnd ClosingPath::Way::end_at(const CompressionTarget& target, Waypoint beyond) {
  if (sharpen_up_to(target, beyond) || let_go_before(target, beyond))
    return search_end(target, std::move(beyond));
  result_.met = target;
  result_.passed_by = measure(beyond.point, target);
  trail_.end_between(trail_.here(), std::move(beyond));
  return PathEnd::target;
}

/// Solves the last state accurately, and those before it until one lies before the target; `beyond`
/// becomes the first accurate one beyond it. Returns false if there is none before the target at
/// which the path may end.
bool ClosingPath::Way::sharpen_up_to(const CompressionTarget& target, Waypoint& beyond) {
  const auto is_before = [&](const Waypoint& at) {
    return measure(at.point, target) < target.value;
  };
  while (may_end(trail_.here()) && is_before(trail_.here())) {
    std::optional<Waypoint> sharp = sharpened(sought());
    if (!sharp) return true;
    if (is_before(*sharp)) {
      trail_.sharpen(std::move(*sharp));
      return true;
    }
    beyond = std::move(*sharp);
    if (!step_back()) return false;
  }
  return false;
}

/// Where the hand still held the last states: lets go at the latest of them that is then before the
/// target. Returns false if there is none.
bool ClosingPath::Way::let_go_before(const CompressionTarget& target, Waypoint& beyond) {
  do {
    const Waypoint& here = trail_.here();
    std::optional<Waypoint> free = solve_again(std::max(here.way, options_.may_end_from), sought());
    if (!free) continue;
    if (measure(free->point, target) < target.value) {
      trail_.sharpen(std::move(*free));
      return true;
    }
    beyond = std::move(*free);
  } while (step_back());
  return false;
}

PathEnd ClosingPath::Way::search_end(const CompressionTarget& target, Waypoint beyond) {
  Bracket bracket(trail_.here(), std::move(beyond), target);
  for (int k = 0; k < most_in_bracket; ++k) {
    if (bracket.meets_target(options_.control_tolerance) || bracket.is_narrow())
      return end_in(bracket, target);
    std::optional<Waypoint> middle = solve_within(bracket);
    if (!middle) {
      trail_.sharpen(bracket.low());
      return PathEnd::no_equilibrium;
    }
    bracket.shrink_to(std::move(*middle));
  }
  trail_.sharpen(bracket.low());
  return PathEnd::solve_limit;
}

/// The equilibrium where the target is expected, or else nearer to the end before it.
std::optional<Waypoint> ClosingPath::Way::solve_within(const Bracket& bracket) {
  double thickness = bracket.thickness();
  for (int k = 0; k <= most_halvings_in_bracket; ++k) {
    std::optional<Waypoint> found =
        solve_at(thickness, bracket.guess_at(thickness), bracket.high().way, sought());
    if (found) return found;
    thickness = 0.5 * (thickness + bracket.low().thickness);
  }
  return {};
}

/// Ends at the better end of the bracket. If that lies beyond another target, the end moves there.
PathEnd ClosingPath::Way::end_in(const Bracket& bracket, const CompressionTarget& target) {
  const Waypoint& low = bracket.low();
  const Waypoint& best = bracket.best();
  const bool met = bracket.meets_target(options_.control_tolerance);
  const CompressionTarget* other = passed(best.point);
  if (met && other != nullptr && other != &target) return search_end(*other, best);
  // If the target is not met, it lies between two equal positions: a point comes into contact, so
  // that only the area changes, or the body snaps through, which is said.
  const double force = std::abs(low.point.paddle_N - bracket.high().point.paddle_N);
  if (!met && force > options_.control_tolerance * best.point.paddle_N) {
    result_.jump = {measure(low.point, target), measure(bracket.high().point, target)};
  }
  result_.met = target;
  trail_.end_between(low, best);
  return PathEnd::target;
}

/// The equilibrium with the plates at a thickness, if it is found.
std::optional<Waypoint> ClosingPath::Way::solve_at(double thickness, const Guess& guess, double way,
                                                   double tolerance) {
  plates_.moved = guess.plates_moved;
  plates_.close_to(thickness);
  if (options_.prepare) options_.prepare(way);
  State state = guess.state;
  solver_.restore(guess.memory);
  ContactStep step = solver_.solve(plates_, state, tolerance);
  record_iterations(step, thickness);
  if (!step.converged) {
    record_failure(step, thickness);
    return {};
  }
  PathPoint point = path_point(solver_, plates_, state, step, area_(state));
  point.thickness = thickness;  // to the last digit, as the path compares it
  result_.points.push_back(point);
  tell(point);
  State moved = step.softer.value_or(state);
  result_.final_step = std::move(step);
  return Waypoint{std::move(state),   solver_.memory(), thickness, point, way,
                  guess.plates_moved, std::move(moved)};
}

std::optional<Waypoint> ClosingPath::Way::sharpened(double tolerance) {
  return solve_again(trail_.here().way, tolerance);
}

/// The last state, solved again at this part of the way and to this residual. It replaces its point
/// on the path.
std::optional<Waypoint> ClosingPath::Way::solve_again(double way, double tolerance) {
  const Waypoint& here = trail_.here();
  std::optional<Waypoint> sharp =
      solve_at(here.thickness, {here.state, here.memory, here.plates_moved}, way, tolerance);
  std::vector<PathPoint>& points = result_.points;
  const std::size_t n = points.size();
  if (sharp && n >= 2 && points[n - 2].thickness == points[n - 1].thickness) {
    points.erase(points.end() - 2);
  }
  return sharp;
}

void ClosingPath::Way::record_iterations(const ContactStep& step, double thickness) {
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
}

void ClosingPath::Way::record_failure(const ContactStep& step, double thickness) {
  ++result_.failures;
  if (step.hurried && !first_haste_) first_haste_ = trail_.here();
  result_.last_failure = step.stop;
  result_.failed_thickness = thickness;
  result_.failed_trial = step.failed_trial;
}

bool ClosingPath::Way::step_back() {
  if (!trail_.step_back()) return false;
  drop_points_beyond_here();
  return true;
}

void ClosingPath::Way::drop_points_beyond_here() {
  std::vector<PathPoint>& points = result_.points;
  while (!points.empty() && points.back().thickness != trail_.here().thickness) points.pop_back();
}

/// Keeps a position if asked for, and forgets those beyond it, from which the path went back.
void ClosingPath::Way::keep(const Waypoint& at) {
  if (!options_.keep) return;
  std::vector<Waypoint>& kept = result_.kept;
  while (!kept.empty() && kept.back().thickness <= at.thickness) kept.pop_back();
  kept.push_back(at);
}

void ClosingPath::Way::tell(const PathPoint& point) const {
  double fraction = -1;
  if (stops_.end && start_thickness_ != *stops_.end)
    fraction = (start_thickness_ - point.thickness) / (start_thickness_ - *stops_.end);
  for (const CompressionTarget& control : stops_.controls)
    fraction = std::max(fraction, std::min(1.0, measure(point, control) / control.value));
  progress_.update(
      "compress", fraction,
      message("thickness ", std::round(10 * point.thickness) / 10, " mm, paddle ",
              std::round(10 * point.paddle_N) / 10, " N, detector ",
              std::round(10 * point.detector_N) / 10, " N, ", point.iterations, " iterations"));
}

/// From the present position, mm.
double ClosingPath::Way::longest_step() const {
  if (options_.longest_step > 0) return options_.longest_step;
  const double way = trail_.here().way;
  const bool slipping =
      way >= options_.slipping_from - same_part && way < options_.slipping_to - same_part;
  const double part =
      slipping ? std::min(options_.slipping_part, options_.longest_part) : options_.longest_part;
  return part * plates_.closing_range;
}

ClosingPath::ClosingPath(ContactSolver& solver, PlatePair& plates, const CompressionTarget& target,
                         PaddleArea area, PathOptions options, Progress& progress)
    : way_(std::make_unique<Way>(solver, plates, target, std::move(area), std::move(options),
                                 progress)) {}

ClosingPath::~ClosingPath() = default;

PathResult ClosingPath::follow(State& state) {
  return way_->follow(state);
}

PathResult ClosingPath::finish(State& state, int iterations_left) {
  return way_->finish(state, iterations_left);
}

PathResult follow_path(ContactSolver& solver, PlatePair& plates, State& state,
                       const CompressionTarget& target, const PaddleArea& area,
                       const PathOptions& options, Progress& progress) {
  return ClosingPath(solver, plates, target, area, options, progress).follow(state);
}

}  // namespace breast
