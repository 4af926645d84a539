// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/waypoint.hpp"

#include <algorithm>

namespace breast {

namespace {

/// Moves the bounds by `ratio` times their last change.
void extrapolate_bounds(const ContactMemory& before, double ratio, ContactMemory& memory) {
  if (before.bounds.size() != memory.bounds.size()) return;
  for (std::size_t c = 0; c < memory.bounds.size(); ++c) {
    const bool stays = memory.touching[c] >= 0 && memory.touching[c] == before.touching[c];
    const double change = memory.bounds[c] - before.bounds[c];
    if (stays) memory.bounds[c] = std::max(0.0, memory.bounds[c] + ratio * change);
  }
}

}  // namespace

Guess extrapolate(const Waypoint& here, const Waypoint* before, double thickness) {
  Guess guess{here.state, here.memory};
  if (before == nullptr) return guess;
  const double ratio = (thickness - here.thickness) / (here.thickness - before->thickness);
  guess.state.x += ratio * (here.moved.x - before->state.x);
  guess.state.p += ratio * (here.moved.p - before->state.p);
  extrapolate_bounds(before->memory, ratio, guess.memory);
  return guess;
}

}  // namespace breast
