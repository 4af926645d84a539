// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of surfaces given as level sets of a distance function.
#pragma once

#include "core/types.hpp"

namespace breast {

/// Unit gradient of `distance` (mm, of a point) at x, by central differences of 0.05 mm.
template <class Distance>
Vec3 level_set_normal(const Distance& distance, const Vec3& x) {
  constexpr double h = 0.05;
  Vec3 gradient;
  for (int a = 0; a < 3; ++a) {
    const Vec3 step = h * Vec3::Unit(a);
    gradient[a] = distance(x + step) - distance(x - step);
  }
  return gradient.normalized();
}

}  // namespace breast
