// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/step_length.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {
/// A step is lengthened by up to these factors to reach a corner of the load or the end.
constexpr double stretch_to_corner = 1.1, stretch_to_end = 1.25;
/// A step may pass a control by this factor, and is never shortened for it to less than this, mm.
constexpr double beyond_control = 1.15, least_closing = 0.5;
/// Distance at which a corner counts as reached, mm.
constexpr double at_corner = 1e-4;

/// Steps longer than this fraction of the longest are abandoned if they begin badly.
constexpr double fast_part = 0.3;
/// A position that took fewer iterations than `quick` lengthens the next step by `longer`; one that
/// took more than `slow` shortens it by `shorter`.
constexpr int quick = 8, slow = 12;
constexpr double longer = 1.4, shorter = 0.7;
}  // namespace

double next_thickness(double step, const PathPoint& here, const PathPoint* before,
                      const PathStops& stops) {
  double closing = step;
  const auto approach = [&](const CompressionTarget& control) {
    // The force grows exponentially.
    const double now = measure(here, control);
    const double then = before != nullptr ? measure(*before, control) : 0;
    if (!(then > 0 && now > then)) return;
    const double growth = std::log(now / then) / (before->thickness - here.thickness);
    closing = std::min(
        closing, std::max(least_closing, std::log(beyond_control * control.value / now) / growth));
  };
  for (const CompressionTarget& control : stops.controls) approach(control);
  for (const CompressionTarget& corner : stops.corner_controls) {
    if (measure(here, corner) < corner.value) approach(corner);
  }
  for (const double corner : stops.corners) {
    const double left = here.thickness - corner;
    if (left > at_corner && left < stretch_to_corner * closing) return corner;
  }
  if (!stops.end) return here.thickness - closing;
  const double left = *stops.end - here.thickness;
  if (std::abs(left) <= stretch_to_end * closing) return *stops.end;
  return here.thickness + std::copysign(closing, left);
}

bool StepLength::may_fail_fast(double length) const {
  return length > fast_part * longest_;
}

void StepLength::adapt(int iterations) {
  // A length that was just found by halving is used twice before it grows again.
  if (iterations < quick && refusals_ == 0) mm_ = std::min(longest_, longer * mm_);
  if (iterations > slow) mm_ = std::max(shortest_, shorter * mm_);
  refusals_ = 0;
}

bool StepLength::halve(double length) {
  ++refusals_;
  mm_ = 0.5 * std::min(mm_, length);
  return mm_ >= shortest_;
}

}  // namespace breast
