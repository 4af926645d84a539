// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/rim.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/statistics/low_pass.hpp"
#include "core/statistics/percentile.hpp"
#include "fit/closest_point.hpp"

namespace breast {

namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> median_of_five(const std::vector<double>& values) {
  const int n = int(values.size());
  std::vector<double> result(n);
  for (int i = 0; i < n; ++i) {
    std::array<double, 5> near{};
    for (int o = 0; o < 5; ++o) near[o] = values[(i + o - 2 + n) % n];
    std::nth_element(near.begin(), near.begin() + 2, near.end());
    result[i] = near[2];
  }
  return result;
}

/// The point at which a ray from the front meets the wall; none if it leaves the sheet.
std::optional<Vec2> hit_wall(const WallSheet& wall, const Vec3& from, const Vec3& direction) {
  double low = 0, high = 0;
  const double reach = 300, step = 2;
  while (high < reach && wall.height_above(from + high * direction) > 0) low = high, high += step;
  if (high >= reach || high == 0) return std::nullopt;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (wall.height_above(from + middle * direction) > 0 ? low : high) = middle;
  }
  const Vec2 st = wall.parameter(from + low * direction);
  if (!(st.minCoeff() > 0.002 && st.maxCoeff() < 0.998)) return std::nullopt;
  return st;
}

/// The first place at which neighbouring straight segments change their sense of rotation or the strip
/// between them folds; none if the cut is simple.
std::optional<std::size_t> crossing(const HermiteSheet& skin, const HermiteSheet& wall,
                                    const Rim& rim) {
  const std::size_t n = rim.skin.size();
  Vec3 before = Vec3::Zero();
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t a = i % n, b = (i + 1) % n;
    const Vec3 p = skin.position(rim.skin[a]), q = skin.position(rim.skin[b]);
    const Vec3 u = wall.position(rim.wall[a]), v = wall.position(rim.wall[b]);
    if (!((q - p).dot(v - u) > 0)) return a;
    const Vec3 normal = (v - p).cross(q - u);
    if (i > 0 && !(normal.dot(before) > 0)) return a;
    before = normal;
  }
  return std::nullopt;
}

/// Lays the cut in these directions; the place where that fails, if it does.
std::optional<std::size_t> lay_cut(const HermiteSheet& skin, const WallSheet& wall,
                                   const std::vector<Vec3>& directions, Rim& rim) {
  rim.wall.clear();
  for (std::size_t i = 0; i < rim.skin.size(); ++i) {
    const auto st = hit_wall(wall, skin.position(rim.skin[i]), directions[i].normalized());
    if (!st) return i;
    rim.wall.push_back(*st);
  }
  if (const auto at = crossing(skin, wall.sheet, rim)) return at;
  if (!star_shaped(rim.wall, centroid(rim.wall))) return 0;
  return std::nullopt;
}

std::optional<std::size_t> choose_cut(const HermiteSheet& skin, const WallSheet& wall, Rim& rim) {
  const SheetLocator locator(wall.sheet, 4);
  std::vector<Vec3> halfway;
  for (const Vec2& st : rim.skin) {
    const Vec3 p = skin.position(st);
    const Vec3 to_wall = (locator.closest(p).x - p).normalized();
    halfway.push_back((to_wall + Vec3(0, 1, 0)).normalized());
  }
  std::optional<std::size_t> failed;
  for (const double sigma : {2.0, 4.0, 8.0, 16.0})
    if (!(failed = lay_cut(skin, wall, low_pass(halfway, sigma), rim))) return failed;
  // Parallel segments cannot cross.
  Vec3 mean = Vec3::Zero();
  for (const Vec3& d : halfway) mean += d;
  for (const Vec3& d : {mean, Vec3(0, 1, 0)})
    if (!(failed = lay_cut(skin, wall, std::vector<Vec3>(halfway.size(), d), rim))) return failed;
  return failed;
}

/// Inner angle in degrees between the cut and a sheet at its rim.
double rim_angle(const HermiteSheet& sheet, const std::vector<Vec2>& rim, std::size_t i,
                 const Vec3& along_cut) {
  const std::size_t n = rim.size();
  const SheetPoint at = sheet.evaluate(rim[i]);
  const Vec3 tangent =
      (sheet.position(rim[(i + 1) % n]) - sheet.position(rim[(i + n - 1) % n])).normalized();
  // The rim runs counter-clockwise about the normal: inwards is to its left.
  const Vec3 inwards = at.normal().cross(tangent).normalized();
  const Vec3 cut = (along_cut - along_cut.dot(tangent) * tangent).normalized();
  return elementary::acos(std::clamp(inwards.dot(cut), -1.0, 1.0)) * 180 / pi;
}

void measure(const HermiteSheet& skin, const HermiteSheet& wall, Rim& rim) {
  std::vector<double> height, at_skin, at_wall;
  for (std::size_t i = 0; i < rim.skin.size(); ++i) {
    const Vec3 cut = wall.position(rim.wall[i]) - skin.position(rim.skin[i]);
    height.push_back(cut.norm());
    at_skin.push_back(rim_angle(skin, rim.skin, i, cut));
    at_wall.push_back(rim_angle(wall, rim.wall, i, -cut));
  }
  rim.cut_height_min_mm = *std::min_element(height.begin(), height.end());
  rim.cut_height_max_mm = *std::max_element(height.begin(), height.end());
  rim.cut_height_median_mm = median(height);
  rim.skin_angle_min = *std::min_element(at_skin.begin(), at_skin.end());
  rim.wall_angle_min = *std::min_element(at_wall.begin(), at_wall.end());
  rim.skin_angle_max = *std::max_element(at_skin.begin(), at_skin.end());
  rim.wall_angle_max = *std::max_element(at_wall.begin(), at_wall.end());
  rim.skin_angle_median = median(at_skin);
  rim.wall_angle_median = median(at_wall);
}

}  // namespace

Vec2 centroid(const std::vector<Vec2>& curve) {
  double area = 0;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 a = curve[i] - curve[0], b = curve[(i + 1) % curve.size()] - curve[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += cross;
    sum += cross * (a + b) / 3;
  }
  return std::abs(area) > 1e-14 ? Vec2(curve[0] + sum / area) : curve[0];
}

bool star_shaped(const std::vector<Vec2>& curve, const Vec2& centre) {
  double turn = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 a = curve[i] - centre, b = curve[(i + 1) % curve.size()] - centre;
    const double angle = elementary::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    if (!(angle > 0)) return false;
    turn += angle;
  }
  return std::abs(turn - 2 * pi) < 1e-6;
}

bool inside_star(const std::vector<Vec2>& curve, const Vec2& centre, const Vec2& st) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 a = curve[i] - centre, b = curve[(i + 1) % curve.size()] - centre, p = st - centre;
    const double det = a.x() * b.y() - a.y() * b.x();
    const double u = (p.x() * b.y() - p.y() * b.x()) / det,
                 v = (a.x() * p.y() - a.y() * p.x()) / det;
    if (u >= 0 && v >= 0) return u + v <= 1;
  }
  return false;
}

namespace {

constexpr double low_pass_degrees = 12;  // standard deviation of the smoothing of the log radius

/// The rim on the skin through these radii, moved outwards by `wider_mm` but not beyond the margin.
std::vector<Vec2> rim_on_skin(const HermiteSheet& skin, const RimRays& rays,
                              const std::vector<double>& radii, double wider_mm,
                              const SheetMargin& margin) {
  std::vector<Vec2> rim;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const Vec2& way = rays.direction[i];
    const double limit = margin_radius(rays.centre, way, margin);
    const double radius = std::min(radii[i], limit);
    const SheetPoint at = skin.evaluate(rays.centre + radius * way);
    const double mm_per_radius = (at.x_s * way.x() + at.x_t * way.y()).norm();
    rim.push_back(rays.centre + std::min(radius + wider_mm / mm_per_radius, limit) * way);
  }
  return rim;
}

/// How far the rim lies beyond the border of the labels.
void compare_with_labels(const HermiteSheet& skin, const RimRays& rays, Rim& rim) {
  std::vector<double> beyond;
  for (std::size_t i = 0; i < rim.skin.size(); ++i) {
    if (rays.end[i] == RimEnd::margin) continue;
    const Vec3 border = skin.position(rays.centre + rays.border[i] * rays.direction[i]);
    const Vec3 at = skin.position(rim.skin[i]);
    const bool outside = (rim.skin[i] - rays.centre).norm() >= rays.border[i];
    beyond.push_back((at - border).norm() * (outside ? 1 : -1));
    if (std::abs(beyond.back()) >= std::max(-rim.beyond_labels_min_mm, rim.beyond_labels_max_mm))
      rim.farthest_beyond = at;
    rim.beyond_labels_min_mm = std::min(rim.beyond_labels_min_mm, beyond.back());
    rim.beyond_labels_max_mm = std::max(rim.beyond_labels_max_mm, beyond.back());
  }
  if (!beyond.empty()) rim.beyond_labels_median_mm = median(std::move(beyond));
}

}  // namespace

Rim lay_rim(const HermiteSheet& skin, const WallSheet& wall, const RimRays& rays,
            const SheetMargin& margin) {
  Rim rim;
  rim.centre = rays.centre;
  rim.end = rays.end;
  rim.greatest_thickness_mm = rays.greatest_thickness_mm;
  std::vector<double> log_radius;
  for (const double radius : rays.radius) log_radius.push_back(elementary::log(radius));
  log_radius = median_of_five(log_radius);
  Vec3 failed_at = Vec3::Zero();
  const double of_turn = double(log_radius.size()) / 360;
  for (const double wider_mm : {0.0, 4.0, -4.0, 8.0, -8.0, 12.0, -12.0}) {
    // A rim over a dented skin may need more smoothing before a cut can be laid.
    for (const double stronger : {1.0, 2.0, 4.0}) {
      std::vector<double> radii = low_pass(log_radius, stronger * of_turn * low_pass_degrees);
      for (double& radius : radii) radius = elementary::exp(radius);
      rim.skin = rim_on_skin(skin, rays, radii, wider_mm, margin);
      const auto failed = choose_cut(skin, wall, rim);
      if (failed && wider_mm == 0) failed_at = skin.position(rim.skin[*failed]);
      if (failed) continue;
      rim.wider_mm = wider_mm;
      measure(skin, wall.sheet, rim);
      compare_with_labels(skin, rays, rim);
      return rim;
    }
  }
  throw input_error(
      "labels: no straight cut joins the skin's rim to the chest wall without crossing itself near (",
      failed_at.x(), ", ", failed_at.y(), ", ", failed_at.z(),
      ") mm, wherever the rim is laid within 12 mm: the wall lies in front of the skin or is too "
      "ragged there; look at this place in segment --overlay and correct it with --chest-wall");
}

}  // namespace breast
