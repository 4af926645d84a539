// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "phantom/normal.hpp"
#include "phantom/random.hpp"

namespace breast {

namespace {
constexpr double degree = std::numbers::pi / 180;

// Union of two bodies with a fillet that ends where their distances differ by `width`.
double filleted_union(double a, double b, double width) {
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - overlap * overlap * overlap * width / 6;
}
}  // namespace

BreastShape::BreastShape(const PhantomParameters& parameters, const Torso& torso, Side side)
    : p_(parameters.side(side)),
      torso_(torso),
      side_(side),
      skin_(parameters.skin),
      seed_(mix(parameters.seed, side == Side::left ? 101 : 102)) {
  const double lateral = lateral_sign(side);
  foot_ = torso_.wall_point(lateral * p_.centre_x, p_.centre_z);
  const double out = p_.axis_lateral * degree, down = p_.axis_inferior * degree;
  axes_[2] = Vec3(lateral * elementary::sin(out) * elementary::cos(down),
                  -elementary::cos(out) * elementary::cos(down), -elementary::sin(down));
  axes_[0] = (Vec3::UnitX() - axes_[2].x() * axes_[2]).normalized();
  axes_[1] = axes_[2].cross(axes_[0]);
  double inside = 0, outside = p_.height + 40;
  if (!(skin_distance(foot_ + outside * axis()) > 0)) {
    throw input_error("phantom breast height ", p_.height, " mm: the axis does not leave the skin");
  }
  for (int i = 0; i < 60; ++i) {
    const double h = 0.5 * (inside + outside);
    (skin_distance(foot_ + h * axis()) < 0 ? inside : outside) = h;
  }
  apex_ = foot_ + inside * axis();
}

Vec3 BreastShape::radial(double azimuth) const {
  return elementary::cos(azimuth) * axes_[0] + elementary::sin(azimuth) * axes_[1];
}

Vec3 BreastShape::cylindrical(const Vec3& x) const {
  const Vec3 d = x - foot_;
  const double a = d.dot(axes_[0]), b = d.dot(axes_[1]);
  return {std::hypot(a, b), elementary::atan2(b, a), d.dot(axes_[2])};
}

double BreastShape::radius(double azimuth) const {
  const double lateral = lateral_sign(side_) * elementary::cos(azimuth),
               up = elementary::sin(azimuth);
  const double tail = std::max(0.0, (lateral + up) / std::numbers::sqrt2);
  return p_.radius * (1 + p_.upper_fullness * up + p_.lateral_fullness * lateral +
                      p_.axillary_tail * tail * tail * tail);
}

double BreastShape::fold(double azimuth) const {
  return p_.fold * (1 + 0.3 * elementary::sin(azimuth));
}

// A cylinder up to the shoulder, a superellipsoidal dome above it.
double BreastShape::body_distance(const Vec3& c) const {
  const double base = radius(c.y()), dome = p_.height - p_.shoulder;
  const double u = c.x() / base, v = std::max(0.0, c.z() - p_.shoulder) / dome;
  const double pu = elementary::pow(u, p_.power - 1), pv = elementary::pow(v, p_.power - 1);
  const double sum = pu * u + pv * v + 1e-12, f = elementary::pow(sum, 1 / p_.power);
  const double fu = f / sum * pu / base, fv = f / sum * pv / dome;
  return (f - 1) / std::max(std::hypot(fu, fv), 0.5 / std::max(base, dome));
}

double BreastShape::skin_distance(const Vec3& x) const {
  const Vec3 c = cylindrical(x);
  double body = body_distance(c);
  const double torso = torso_.skin_distance(x), raised = smooth_step(torso, 5, 25);
  if (raised > 0) body += p_.unevenness * raised * lattice_noise(seed_, x / 38);
  return filleted_union(body, torso, fold(c.y()));
}

double BreastShape::beyond_fold(const Vec3& x, double part) const {
  const Vec3 c = cylindrical(x);
  return body_distance(c) - torso_.skin_distance(x) - part * fold(c.y());
}

double BreastShape::nipple_distance(const Vec3& x) const {
  const Vec3 d = x - apex_;
  const double radius = p_.nipple_radius;
  const double along = std::clamp(d.dot(axis()), -4.0, p_.nipple_height - 0.6 * radius);
  // A blunt papilla: a capsule flattened along the axis.
  Vec3 rest = d - along * axis();
  const double tip = rest.dot(axis());
  if (tip > 0) rest += (1 / 0.6 - 1) * tip * axis();
  return rest.norm() - radius;
}

double BreastShape::outline(const Vec3& x) const {
  return filleted_union(skin_distance(x), nipple_distance(x), 4.0);
}

double BreastShape::skin_thickness(const Vec3& x) const {
  const double from_apex = (x - apex_).norm();
  return skin_ * (1 + 0.10 * lattice_noise(seed_ + 1, x / 30)) +
         1.0 * (1 - smooth_step(from_apex, 10, 20));
}

Vec3 BreastShape::skin_normal(const Vec3& x) const {
  return level_set_normal([this](const Vec3& at) { return skin_distance(at); }, x);
}

}  // namespace breast
