// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/closing_states.hpp"

#include <algorithm>
#include <cmath>

#include "contact/results.hpp"
#include "core/error.hpp"
#include "mechanics/load_steps.hpp"
#include "mechanics/solution.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

/// A position to be solved: where the plates stand, from which state, under the load of which part of
/// the way.
struct Position {
  double thickness = 0, way = 0;
  Guess guess;
};

Position at_waypoint(const Waypoint& at) {
  return {at.thickness, at.way, {at.state, at.memory, at.plates_moved}};
}

Position between(const Waypoint& before, const Waypoint& beyond, double thickness) {
  const double w = (before.thickness - thickness) / (before.thickness - beyond.thickness);
  return {thickness, before.way + w * (beyond.way - before.way),
          interpolate(before, beyond, thickness)};
}

class ClosingStates {
 public:
  ClosingStates(const Scene& scene, const CompressionOptions& options,
                const CompressionResult& found, const PathOptions& path, const DeadLoad& load,
                ContactSolver& contact, Progress& progress)
      : scene_(scene),
        options_(options),
        found_(found),
        path_(path),
        load_(load),
        contact_(contact),
        progress_(progress) {}

  ClosingState at(double thickness);

 private:
  std::vector<Position> positions(double thickness) const;
  bool solve(const Position& position, ClosingState& state);
  void record(const Position& position, const State& solution, ContactStep step,
              const PlatePair& plates, ClosingState& state) const;

  const Scene& scene_;
  const CompressionOptions& options_;
  const CompressionResult& found_;
  const PathOptions& path_;
  const DeadLoad& load_;
  ContactSolver& contact_;
  Progress& progress_;
};

/// What is tried for a thickness, in this order.
std::vector<Position> ClosingStates::positions(double thickness) const {
  const std::vector<Waypoint>& kept = found_.path.kept;
  const auto beyond =
      std::ranges::find_if(kept, [&](const Waypoint& at) { return at.thickness < thickness; });
  if (beyond == kept.begin()) return {at_waypoint(kept.front())};
  const Waypoint& before = *std::prev(beyond);
  if (beyond == kept.end() || before.thickness == thickness) return {at_waypoint(before)};
  Position unmoved = between(before, *beyond, thickness);
  unmoved.guess.state = before.state;
  const bool first_nearer = before.thickness - thickness < thickness - beyond->thickness;
  return {between(before, *beyond, thickness), std::move(unmoved),
          at_waypoint(first_nearer ? before : *beyond)};
}

ClosingState ClosingStates::at(double thickness) {
  ClosingState state;
  state.thickness = thickness;
  for (const Position& position : positions(thickness))
    if (solve(position, state)) break;
  return state;
}

bool ClosingStates::solve(const Position& position, ClosingState& state) {
  PlatePair plates = found_.plates;
  plates.moved = position.guess.plates_moved;
  plates.close_to(position.thickness);
  if (path_.prepare) path_.prepare(position.way);
  State solution = position.guess.state;
  contact_.restore(position.guess.memory);
  ContactStep step = contact_.solve(plates, solution, path_.tolerance);
  SolveLog log(state, progress_);
  ++state.steps;
  for (const NewtonIteration& iteration : step.iterations) log.record(state.steps, iteration);
  state.residual = step.residual;
  if (!step.converged) {
    state.reason_id = stop_name(step.stop);
    state.record.reason =
        message("with the plates ", position.thickness,
                " mm apart: ", step.reason.empty() ? describe(step.stop) : step.reason);
    return false;
  }
  state.reason_id.clear();
  state.record.reason.clear();
  state.record.status = SolveStatus::converged;
  state.thickness = position.thickness;
  record(position, solution, std::move(step), plates, state);
  return true;
}

/// Fills shape, contact and hand.
void ClosingStates::record(const Position& position, const State& solution, ContactStep step,
                           const PlatePair& plates, ClosingState& state) const {
  CompressionResult result;
  result.plates = plates;
  result.pose = found_.pose;
  for (const PathPoint& point : found_.path.points)
    if (point.thickness >= position.thickness) result.path.points.push_back(point);
  result.path.final_step = std::move(step);
  result.min_det_F = result.path.final_step.forces.min_det_F;
  record_compression(scene_, options_, solution, contact_, load_.total(), result);
  conclude(result, scene_, solution, options_.gravity);
  state.reference = std::move(result.reference);
  state.points = std::move(result.points);
  state.pressure = std::move(result.pressure);
  state.det_F = std::move(result.det_F);
  state.gravity = result.gravity;
  state.contact = std::move(result.contact);
  state.contact_pressure = std::move(result.contact_pressure);
  state.min_det_F = result.min_det_F;
  state.max_volume_error = result.max_volume_error;
  if (options_.positioning == Positioning::hanging) return;
  const Hand hand;
  state.hand_carries = 1 - hand.weight.at(position.way);
  state.hand_pulls_N = options_.pull_N * (1 - hand.pull.at(position.way));
}

}  // namespace

std::vector<ClosingState> solve_closing(const Scene& scene, const CompressionOptions& options,
                                        const CompressionResult& found, const PathOptions& path,
                                        const DeadLoad& load, int count, ContactSolver& contact,
                                        Progress& progress) {
  const std::vector<Waypoint>& kept = found.path.kept;
  std::vector<ClosingState> states;
  if (kept.empty()) return states;
  ClosingStates closing(scene, options, found, path, load, contact, progress);
  const double first = kept.front().thickness, last = kept.back().thickness;
  for (int k = 0; k < count; ++k) {
    progress.update("states", double(k) / count, message("state ", k + 1, " of ", count + 1));
    states.push_back(closing.at(first + (last - first) * k / count));
  }
  return states;
}

}  // namespace breast
