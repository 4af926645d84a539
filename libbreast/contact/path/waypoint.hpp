// SPDX-License-Identifier: GPL-3.0-or-later
// Converged states along the path: what the plates do there, the initial state that they suggest
// for the next position, and the trail by which the path can go back.
#pragma once

#include <deque>
#include <optional>

#include "contact/path/target.hpp"
#include "contact/plates.hpp"
#include "contact/solvers/solver.hpp"

namespace breast {

/// A converged state to which the path can return.
struct Waypoint {
  State state;
  ContactMemory memory;
  double thickness = 0;  ///< mm
  PathPoint point;
  double way = 0;           ///< the part of the way to the target for which its load was set
  double plates_moved = 0;  ///< PlatePair::moved
  /// The state to which the motion of the plates alone led: `state`, unless the plates became stiffer
  /// at the same position.
  State moved;
};

/// Forces, area and mean pressure of the plates in a converged state. `paddle_area`: area (mm²) that
/// touches the paddle.
PathPoint path_point(const ContactSolver& solver, const PlatePair& plates, const State& state,
                     const ContactStep& step, double paddle_area);

/// Initial state of a solve and what the contact method remembers.
struct Guess {
  State state;
  ContactMemory memory;
  double plates_moved = 0;  ///< PlatePair::moved there
};

/// Between two states of a path at a thickness (mm), linearly in positions, pressures and the place of the plates;
/// friction is that of `before`.
Guess interpolate(const Waypoint& before, const Waypoint& beyond, double thickness);

/// Extrapolates positions, pressures, and the friction bounds of the nodes that stay on their plate
/// linearly from `before` and `here` to a thickness (mm). Returns `here` itself if `before` is null.
Guess extrapolate(const Waypoint& here, const Waypoint* before, double thickness);

/// The last states of a path, for extrapolation, and for a return when the last one turns out not to
/// be an equilibrium.
class Trail {
 public:
  /// Begins at a state, at which a return ends.
  void begin(Waypoint start);
  const Waypoint& here() const { return here_; }
  /// The state before here(); null at the start and after a return to it.
  const Waypoint* before() const { return before_ ? &*before_ : nullptr; }
  /// Goes on to the next state.
  void advance(Waypoint next);
  /// The same state, solved more accurately.
  void sharpen(Waypoint sharp) { here_ = std::move(sharp); }
  /// Ends between two states that replace the last two.
  void end_between(Waypoint before, Waypoint last);
  /// Returns to the state before here(); false if the path is at its start.
  bool step_back();
  /// Goes on from an earlier state, without a state before it.
  void restart_at(Waypoint earlier);

 private:
  Waypoint start_, here_;
  std::optional<Waypoint> before_;
  std::deque<Waypoint> earlier_;  // than before_
};

}  // namespace breast
