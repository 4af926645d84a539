// SPDX-License-Identifier: GPL-3.0-or-later
// A spring that resists one direction only, and whose stiffness sets in gradually.
#pragma once

namespace breast {

/// Energy, its derivative and its second derivative, per whatever the stiffness is per.
struct ToeSpring {
  double energy = 0, force = 0, stiffness = 0;
};

/// ψ(d) for a deflection d, with ψ' = 0 for d ≤ 0, k d² / 2w for d ≤ w and k (d − w/2) beyond: the
/// stiffness rises from zero to k over the width w of the toe, so that the tangent is continuous.
inline ToeSpring toe_spring(double d, double w, double k) {
  if (!(d > 0)) return {};
  if (d <= w) return {k * d * d * d / (6 * w), k * d * d / (2 * w), k * d / w};
  const double beyond = d - w;
  return {k * (w * w / 6 + 0.5 * w * beyond + 0.5 * beyond * beyond), k * (d - 0.5 * w), k};
}

}  // namespace breast
