// SPDX-License-Identifier: GPL-3.0-or-later
// Converged states along the path, and the initial state that they suggest for the next position of
// the plates.
#pragma once

#include "contact/path/target.hpp"
#include "contact/solvers/solver.hpp"

namespace breast {

/// A converged state to which the path can return.
struct Waypoint {
  State state;
  ContactMemory memory;
  double thickness = 0;  ///< mm
  PathPoint point;
  /// The state to which the motion of the plates alone led: `state`, unless the plates became stiffer
  /// at the same position.
  State moved;
};

/// Initial state of a solve and what the contact method remembers.
struct Guess {
  State state;
  ContactMemory memory;
};

/// Extrapolates positions, pressures, and the friction bounds of the nodes that stay on their plate
/// linearly from `before` and `here` to a thickness (mm). Returns `here` itself if `before` is null.
Guess extrapolate(const Waypoint& here, const Waypoint* before, double thickness);

}  // namespace breast
