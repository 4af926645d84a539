// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/chest/rib_surface.hpp"

#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace breast {

RibSurface::RibSurface(const TorsoParameters& torso) : torso_(torso) {
  if (!(torso.power >= 2)) {
    throw input_error("phantom torso power ", torso.power,
                      ": must be at least 2 for a breast that slides on it");
  }
}

// f = (|u|^p + |v|^p)^(1/p) with u = x/a and v = (y − c(z))/b.
std::optional<Level> RibSurface::at(const Vec3& x) const {
  constexpr double near_centre = 0.25;
  const double a = torso_.half_width, b = torso_.half_depth, p = torso_.power, z = x.z();
  const double u = x.x() / a, v = (x.y() - (b + torso_.tilt * z + torso_.bend * z * z)) / b;
  const double sum = elementary::pow(std::abs(u), p) + elementary::pow(std::abs(v), p);
  const double f = elementary::pow(sum, 1 / p);
  if (!(f > near_centre)) return std::nullopt;
  // Relative coordinates make the powers those of numbers up to 1.
  const double s = std::abs(u) / f, t = std::abs(v) / f;
  const double fu = std::copysign(elementary::pow(s, p - 1), u),
               fv = std::copysign(elementary::pow(t, p - 1), v);
  const double fuu = (p - 1) / f * (elementary::pow(s, p - 2) - fu * fu),
               fvv = (p - 1) / f * (elementary::pow(t, p - 2) - fv * fv),
               fuv = -(p - 1) / f * fu * fv;
  const Vec3 du(1 / a, 0, 0), dv(0, 1 / b, -(torso_.tilt + 2 * torso_.bend * z) / b);
  Level level;
  level.value = (f - 1) * b;
  level.gradient = b * (fu * du + fv * dv);
  level.hessian = b * (fuu * du * du.transpose() + fvv * dv * dv.transpose() +
                       fuv * (du * dv.transpose() + dv * du.transpose()));
  level.hessian(2, 2) -= 2 * torso_.bend * fv;
  return level;
}

}  // namespace breast
