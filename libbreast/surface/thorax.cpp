// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/thorax.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace breast {

namespace {

constexpr double nearest_axis = 0.25;  // of the radius

/// R and its derivatives with respect to angle and height.
struct Radius {
  double value = 0, a = 0, z = 0, aa = 0, az = 0, zz = 0;
};

Radius radius_at(const ThoraxSurface& thorax, double angle, double height) {
  const SplinePlace at = spline_place(angle, thorax.angle_low, thorax.angle_high, thorax.angles);
  const SplinePlace up =
      spline_place(height, thorax.height_low, thorax.height_high, thorax.heights);
  const CubicSpline a = cubic_spline(at.t), z = cubic_spline(up.t);
  Radius r;
  for (int j = 0; j < 4; ++j) {
    const double* row = thorax.coefficients.data() +
                        std::size_t(up.interval + j) * std::size_t(thorax.angles + 3) +
                        std::size_t(at.interval);
    double value = 0, first = 0, second = 0;
    for (int i = 0; i < 4; ++i) {
      value += a.value[i] * row[i];
      first += a.first[i] * row[i];
      second += a.second[i] * row[i];
    }
    r.value += z.value[j] * value;
    r.a += z.value[j] * first;
    r.aa += z.value[j] * second;
    r.z += z.first[j] * value;
    r.az += z.first[j] * first;
    r.zz += z.second[j] * value;
  }
  const double da = thorax.angles / (thorax.angle_high - thorax.angle_low);
  const double dz = thorax.heights / (thorax.height_high - thorax.height_low);
  r.a *= da, r.aa *= da * da, r.z *= dz, r.zz *= dz * dz, r.az *= da * dz;
  return r;
}

}  // namespace

CubicSpline cubic_spline(double t) {
  const double s = 1 - t;
  return {{s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
           t * t * t / 6},
          {-s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * s * s + 4 * s) / 2, t * t / 2},
          {s, 3 * t - 2, 3 * s - 2, t}};
}

SplinePlace spline_place(double at, double low, double high, int count) {
  const double scaled = (at - low) / (high - low) * count;
  const int interval = std::clamp(int(std::floor(scaled)), 0, count - 1);
  return {interval, scaled - interval};
}

AxisPlace about_axis(const ThoraxSurface& thorax, const Vec3& x) {
  const double height = x.z() - thorax.origin.z();
  return {x.x() - thorax.origin.x(), thorax.origin.y() + thorax.slope * height - x.y(), height};
}

double angle_of(const AxisPlace& place) {
  return elementary::atan2(place.left, place.front);
}

std::optional<Level> ThoraxSurface::at(const Vec3& x) const {
  const AxisPlace place = about_axis(*this, x);
  const double u = place.left, v = place.front, square = u * u + v * v, rho = std::sqrt(square);
  const double angle = angle_of(place);
  if (!(angle >= angle_low && angle <= angle_high && place.height >= height_low &&
        place.height <= height_high)) {
    return {};
  }
  const Radius r = radius_at(*this, angle, place.height);
  if (!(rho > nearest_axis * r.value)) return {};
  const double au = v / square, av = -u / square;
  const double auu = -2 * u * v / (square * square);
  const double auv = (u * u - v * v) / (square * square);
  // First with respect to (u, v, height), then to (x, y, z): u and v are linear in them.
  const Vec3 gradient(u / rho - r.a * au, v / rho - r.a * av, -r.z);
  const double cube = square * rho;
  Mat3 hessian;
  hessian(0, 0) = v * v / cube - r.aa * au * au - r.a * auu;
  hessian(0, 1) = hessian(1, 0) = -u * v / cube - r.aa * au * av - r.a * auv;
  hessian(1, 1) = u * u / cube - r.aa * av * av + r.a * auu;
  hessian(0, 2) = hessian(2, 0) = -r.az * au;
  hessian(1, 2) = hessian(2, 1) = -r.az * av;
  hessian(2, 2) = -r.zz;
  Mat3 turn;
  turn << 1, 0, 0, 0, -1, slope, 0, 0, 1;
  return Level{rho - r.value, turn.transpose() * gradient, turn.transpose() * hessian * turn};
}

Vec3 ThoraxSurface::point(double angle, double height) const {
  const double r = radius_at(*this, angle, height).value;
  return {origin.x() + r * elementary::sin(angle),
          origin.y() + slope * height - r * elementary::cos(angle), origin.z() + height};
}

// R shrinks by depth·|∇φ|. As coefficients of the spline its values at the Greville points (the
// knots, here) reproduce it to second order of the spacing, and it varies slowly.
ThoraxSurface surface_behind(const ThoraxSurface& front, double depth) {
  ThoraxSurface behind = front;
  const double da = (front.angle_high - front.angle_low) / front.angles;
  const double dz = (front.height_high - front.height_low) / front.heights;
  const auto knot = [](int i, int last) { return std::clamp(i - 1, 0, last); };
  for (int j = 0; j < front.heights + 3; ++j) {
    for (int i = 0; i < front.angles + 3; ++i) {
      const double angle = front.angle_low + da * knot(i, front.angles);
      const double height = front.height_low + dz * knot(j, front.heights);
      const Radius r = radius_at(front, angle, height);
      const double along_arc = r.a / r.value;
      behind.coefficients[std::size_t(j) * std::size_t(front.angles + 3) + std::size_t(i)] -=
          depth * std::sqrt(1 + along_arc * along_arc + r.z * r.z);
    }
  }
  return behind;
}

}  // namespace breast
