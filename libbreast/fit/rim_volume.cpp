// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/rim_volume.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fit/fit_breast.hpp"

namespace breast {

namespace {

constexpr double farthest = 20;  // mm
// Relative differences of the volume: the one that needs no move, and the target and accuracy of a
// move.
constexpr double allowed = 5e-3, aim = 4e-3, good_enough = 1e-3;

void set_rim(const Rim& rim, BreastGeometry& geometry) {
  geometry.centre = rim.centre;
  geometry.rim_skin = rim.skin;
  geometry.rim_wall = rim.wall;
  geometry.rim_end = rim.end;
}

}  // namespace

Rim rim_of_volume(double wanted_ml, const WallSheet& wall, const RimRays& rays,
                  const RimOptions& options, BreastGeometry& geometry) {
  Rim best = lay_rim(geometry.skin, wall, rays, 0, options);
  const auto excess_of = [&](const Rim& rim) {
    set_rim(rim, geometry);
    return enclosed_volume(geometry) / mm3_per_ml / wanted_ml - 1;
  };
  const double walked = excess_of(best);
  if (std::abs(walked) <= allowed) return best;
  const double goal = std::copysign(aim, walked);
  double miss = walked - goal;
  // Bisection between the rim found by the rays and the farthest rim on the side that reduces the
  // difference: the volume grows with the rim, and a cut that cannot be constructed counts as too
  // far.
  double near = 0, far = miss > 0 ? -farthest : farthest;
  for (int step = 0; step < 12 && std::abs(miss) > good_enough; ++step) {
    const double middle = step == 0 ? far : 0.5 * (near + far);
    try {
      const Rim rim = lay_rim(geometry.skin, wall, rays, middle, options);
      const double now = excess_of(rim) - goal;
      const bool short_of_it = (now > 0) == (far < 0);
      if (step > 0 || short_of_it) (short_of_it ? near : far) = middle;
      if (std::abs(now) < std::abs(miss)) best = rim, miss = now;
      if (step == 0 && short_of_it) break;  // even the farthest does not get there
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::input) throw;
      far = middle;
    }
  }
  set_rim(best, geometry);
  return best;
}

}  // namespace breast
