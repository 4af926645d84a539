// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/meridian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace breast {

namespace {

constexpr int n_azimuth = 64, n_inner = 48, n_outer = 12;
constexpr int n_points = n_inner + n_outer + 1;

using Field = std::function<double(const Vec2&)>;
using Curve = std::vector<Vec2>;

Vec2 gradient(const Field& field, const Vec2& p) {
  constexpr double h = 0.02;
  return Vec2(field(p + Vec2(h, 0)) - field(p - Vec2(h, 0)),
              field(p + Vec2(0, h)) - field(p - Vec2(0, h))) /
         (2 * h);
}

Vec2 onto(const Field& field, Vec2 p) {
  for (int i = 0; i < 4; ++i) {
    const Vec2 g = gradient(field, p);
    p -= field(p) * g / g.squaredNorm();
  }
  return p;
}

// Follows field = 0 from `p`, initially outwards (+r), until `stop` is positive; the last step ends
// exactly where it changes sign.
Curve follow(const Field& field, Vec2 p, const Field& stop) {
  constexpr double step = 0.5;
  Curve curve = {p};
  Vec2 heading(1, 0);
  while (true) {
    if (curve.size() > 2000) throw input_error("phantom: the skin does not run out onto the chest");
    const Vec2 g = gradient(field, p).normalized();
    Vec2 tangent(-g.y(), g.x());
    if (tangent.dot(heading) < 0) tangent = -tangent;
    heading = tangent;
    const Vec2 next = onto(field, p + step * tangent);
    if (stop(next) > 0) {
      double low = 0, high = 1;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (stop(p + middle * (next - p)) > 0 ? high : low) = middle;
      }
      curve.push_back(onto(field, p + high * (next - p)));
      return curve;
    }
    p = next;
    curve.push_back(p);
  }
}

// `count` + 1 points of equal arc length.
Curve resample(const Curve& curve, int count) {
  std::vector<double> length(curve.size(), 0);
  for (std::size_t i = 1; i < curve.size(); ++i)
    length[i] = length[i - 1] + (curve[i] - curve[i - 1]).norm();
  Curve out(count + 1);
  std::size_t at = 0;
  for (int i = 0; i <= count; ++i) {
    const double target = length.back() * i / count;
    while (at + 2 < curve.size() && length[at + 1] < target) ++at;
    const double t = (target - length[at]) / (length[at + 1] - length[at]);
    out[i] = curve[at] + std::clamp(t, 0.0, 1.0) * (curve[at + 1] - curve[at]);
  }
  return out;
}

Curve join(const Curve& inner, const Curve& outer) {
  Curve out = resample(inner, n_inner);
  const Curve rest = resample(outer, n_outer);
  out.insert(out.end(), rest.begin() + 1, rest.end());
  return out;
}

struct Plane {
  Curve skin, wall;
};

// From the end of the fold to the cut, mm.
double rim_width(const BreastShape& shape, double beyond, double azimuth) {
  const BreastParameters& p = shape.parameters();
  const double towards_side = 0.5 * (1 + lateral_sign(shape.side()) * elementary::cos(azimuth));
  const double square = towards_side * towards_side;
  return p.rim + p.flank * square + beyond * square * square;
}

Plane meridian_plane(const BreastShape& shape, double beyond, double azimuth) {
  const auto point = [&](const Vec2& p) { return shape.at(p.x(), azimuth, p.y()); };
  const Field skin = [&](const Vec2& p) { return shape.skin_distance(point(p)); };
  const Field wall = [&](const Vec2& p) { return shape.torso().wall_distance(point(p)); };
  const Vec2 apex(0, (shape.apex() - shape.foot()).norm());
  const Curve dome = follow(skin, apex, [&](const Vec2& p) {
    return p.x() > 10 ? shape.beyond_fold(point(p), 0.0) : -1.0;
  });
  const Vec2 fold = dome.back();
  const double width = rim_width(shape, beyond, azimuth);
  const Curve skirt =
      follow(skin, fold, [&](const Vec2& p) { return shape.beyond_fold(point(p), 1.0) - width; });
  // Base points of fold and rim: perpendicular to the wall.
  const Vec2 fold_foot = onto(wall, fold), rim_foot = onto(wall, skirt.back());
  const Curve inner =
      follow(wall, Vec2(0, 0), [&](const Vec2& p) { return p.x() - fold_foot.x(); });
  const Curve outer =
      follow(wall, inner.back(), [&](const Vec2& p) { return p.x() - rim_foot.x(); });
  return {join(dome, skirt), join(inner, outer)};
}

// Catmull-Rom weights of the four neighbours of fraction t.
std::array<double, 4> cubic_weights(double t) {
  return {0.5 * t * (-1 + t * (2 - t)), 0.5 * (2 + t * t * (-5 + 3 * t)),
          0.5 * t * (1 + t * (4 - 3 * t)), 0.5 * t * t * (t - 1)};
}

}  // namespace

MeridianMap::MeridianMap(const BreastShape& shape, double beyond)
    : shape_(shape), skin_(n_azimuth), wall_(n_azimuth) {
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) num_threads(threads())
  for (int j = 0; j < n_azimuth; ++j) {
    try {
      Plane plane = meridian_plane(shape, beyond, 2 * std::numbers::pi * j / n_azimuth);
      skin_[j] = std::move(plane.skin);
      wall_[j] = std::move(plane.wall);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  for (const Curve& curve : skin_) fold_height_ += curve[n_inner].y() / n_azimuth;
}

// Interpolates linearly between points of a curve (they are 1-2 mm apart, and the mesh's nodes are
// returned to the surface afterwards), and by cubics between azimuths.
Vec3 MeridianMap::position(const std::vector<Curve>& curves, double parameter,
                           double azimuth) const {
  const double along = parameter <= 1 ? std::max(parameter, 0.0) * n_inner
                                      : n_inner + std::min(parameter - 1, 1.0) * n_outer;
  const int i = std::min(int(along), n_points - 2);
  const double turn = azimuth / (2 * std::numbers::pi);
  const double around = (turn - std::floor(turn)) * n_azimuth;
  const int j = int(around);
  const std::array<double, 4> weight = cubic_weights(around - j);
  Vec2 p(0, 0);
  for (int b = 0; b < 4; ++b) {
    const Curve& curve = curves[(j + b - 1 + n_azimuth) % n_azimuth];
    p += weight[b] * (curve[i] + (along - i) * (curve[i + 1] - curve[i]));
  }
  return shape_.at(p.x(), azimuth, p.y());
}

bool MeridianMap::inside_cut(const Vec3& x, double margin) const {
  const Vec3 at = shape_.cylindrical(x);
  if (at.x() > 2.5 * shape_.radius(at.y()) || at.z() < -shape_.parameters().radius) return false;
  const Vec3 foot = shape_.cylindrical(wall(2, at.y())), rim = shape_.cylindrical(skin(2, at.y()));
  const double rise = (at.z() - foot.z()) / (rim.z() - foot.z());
  return at.x() < foot.x() + rise * (rim.x() - foot.x()) - margin;
}

}  // namespace breast
