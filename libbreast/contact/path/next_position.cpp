// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/next_position.hpp"

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
}  // namespace

double next_thickness(double step, const PathPoint& here, const PathPoint* before,
                      const PathStops& stops) {
  double closing = step;
  for (const CompressionTarget& control : stops.controls) {
    // The force grows exponentially.
    const double now = measure(here, control.kind);
    const double then = before != nullptr ? measure(*before, control.kind) : 0;
    if (!(then > 0 && now > then)) continue;
    const double growth = std::log(now / then) / (before->thickness - here.thickness);
    closing = std::min(
        closing, std::max(least_closing, std::log(beyond_control * control.value / now) / growth));
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

}  // namespace breast
