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

/// Thickness of tissue (mm) between skin and wall on a raster of the skin's parameters.
class ThicknessMap {
 public:
  ThicknessMap(const HermiteSheet& skin, const WallSheet& wall, int count) : n_(count) {
    value_.resize(std::size_t(n_) * n_);
    const SheetLocator locator(wall.sheet, 4);
#pragma omp parallel for schedule(dynamic)
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        const Vec3 p = skin.position(parameter(i, j));
        const SheetFoot foot = locator.closest(p);
        const double sign = wall.height_above(p) >= 0 ? 1 : -1;
        value_[std::size_t(j) * n_ + i] = sign * foot.distance;
      }
  }
  int count() const {
    return n_;
  }
  Vec2 parameter(int i, int j) const {
    return {double(i) / (n_ - 1), double(j) / (n_ - 1)};
  }
  double node(int i, int j) const {
    return value_[std::size_t(j) * n_ + i];
  }
  double at(const Vec2& st) const {
    const double u = std::clamp(st.x(), 0.0, 1.0) * (n_ - 1);
    const double v = std::clamp(st.y(), 0.0, 1.0) * (n_ - 1);
    const int i = std::min(int(u), n_ - 2), j = std::min(int(v), n_ - 2);
    const double a = u - i, b = v - j;
    return (1 - a) * (1 - b) * node(i, j) + a * (1 - b) * node(i + 1, j) +
           (1 - a) * b * node(i, j + 1) + a * b * node(i + 1, j + 1);
  }

 private:
  int n_;
  std::vector<double> value_;
};

/// The thickest position near the nipple, and the centroid of the region connected to it with more
/// than 0.6 of its thickness.
struct Core {
  Vec2 centre;
  double thickest;
};

Core thick_core(const ThicknessMap& map, const Vec2& nipple_st) {
  const int n = map.count();
  int best_i = -1, best_j = -1;
  double thickest = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if ((map.parameter(i, j) - nipple_st).norm() < 0.2 && map.node(i, j) > thickest)
        thickest = map.node(i, j), best_i = i, best_j = j;
  std::vector<char> mark(std::size_t(n) * n, 0);
  std::vector<std::pair<int, int>> stack{{best_i, best_j}};
  mark[std::size_t(best_j) * n + best_i] = 1;
  Vec2 sum = Vec2::Zero();
  int count = 0;
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    sum += map.parameter(i, j);
    ++count;
    const int next[4][2] = {{i + 1, j}, {i - 1, j}, {i, j + 1}, {i, j - 1}};
    for (const auto& q : next) {
      if (q[0] < 0 || q[1] < 0 || q[0] >= n || q[1] >= n) continue;
      char& m = mark[std::size_t(q[1]) * n + q[0]];
      if (m == 0 && map.node(q[0], q[1]) > 0.6 * thickest) m = 1, stack.emplace_back(q[0], q[1]);
    }
  }
  return {sum / count, thickest};
}

/// Tissue on the midline: median thickness along the skin sheet's medial edge, middle heights.
double sternal_thickness(const ThicknessMap& map, Side side) {
  std::vector<double> edge;
  const double s = side == Side::left ? 0.0 : 1.0;
  for (int k = 0; k <= 40; ++k) edge.push_back(map.at({s, 0.3 + 0.4 * k / 40}));
  std::nth_element(edge.begin(), edge.begin() + 20, edge.end());
  return edge[20];
}

/// Limit of a ray: a rounded square (superellipse), so that the rim has no corners.
double margin_radius(const Vec2& centre, const Vec2& direction, const RimOptions& options) {
  double low = 0, high = 1.5;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (within_margin(centre + middle * direction, options.margin) ? low : high) = middle;
  }
  return low;
}

struct RayEnd {
  double radius;
  RimEnd reason;
};

RayEnd walk(const HermiteSheet& skin, const ThicknessMap& map, const Core& core,
            const Vec2& direction, double t_min, const RimOptions& options) {
  const double limit = margin_radius(core.centre, direction, options);
  const double step = 0.004;
  const int steps = std::max(2, int(limit / step));
  std::vector<double> arc(steps + 1, 0), tau(steps + 1);
  Vec3 last;
  for (int k = 0; k <= steps; ++k) {
    const Vec2 st = core.centre + direction * (limit * k / steps);
    const Vec3 x = skin.position(st);
    if (k > 0) arc[k] = arc[k - 1] + (x - last).norm();
    last = x;
    tau[k] = map.at(st);
  }
  const double window = 10;  // mm of arc for the slope
  const double flat = elementary::sin(options.slope_degrees * pi / 180);
  const double steep = elementary::sin(options.steep_degrees * pi / 180);
  for (int k = 1; k <= steps; ++k) {
    const double radius = limit * k / steps;
    if (!(tau[k] >= options.steep_down_to * t_min)) return {radius, RimEnd::thin_tissue};
    if (tau[k] > options.slope_below * core.thickest) continue;
    int a = k, b = k;
    while (a > 0 && arc[k] - arc[a] < window / 2) --a;
    while (b < steps && arc[b] - arc[k] < window / 2) ++b;
    const double thinning = -(tau[b] - tau[a]) / (arc[b] - arc[a]);
    if (tau[k] < t_min && thinning < steep) return {radius, RimEnd::thin_tissue};
    if (thinning < flat) return {radius, RimEnd::slope};
  }
  return {limit, RimEnd::margin};
}

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

/// Whether neighbouring straight segments have the same sense of rotation and the strip between
/// them does not fold.
bool cut_is_simple(const HermiteSheet& skin, const HermiteSheet& wall, const Rim& rim) {
  const std::size_t n = rim.skin.size();
  Vec3 before = Vec3::Zero();
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t a = i % n, b = (i + 1) % n;
    const Vec3 p = skin.position(rim.skin[a]), q = skin.position(rim.skin[b]);
    const Vec3 u = wall.position(rim.wall[a]), v = wall.position(rim.wall[b]);
    if (!((q - p).dot(v - u) > 0)) return false;
    const Vec3 normal = (v - p).cross(q - u);
    if (i > 0 && !(normal.dot(before) > 0)) return false;
    before = normal;
  }
  return true;
}

bool lay_cut(const HermiteSheet& skin, const WallSheet& wall, const std::vector<Vec3>& directions,
             Rim& rim) {
  rim.wall.clear();
  for (std::size_t i = 0; i < rim.skin.size(); ++i) {
    const auto st = hit_wall(wall, skin.position(rim.skin[i]), directions[i].normalized());
    if (!st) return false;
    rim.wall.push_back(*st);
  }
  return star_shaped(rim.wall, centroid(rim.wall)) && cut_is_simple(skin, wall.sheet, rim);
}

bool choose_cut(const HermiteSheet& skin, const WallSheet& wall, Rim& rim) {
  const SheetLocator locator(wall.sheet, 4);
  std::vector<Vec3> halfway;
  for (const Vec2& st : rim.skin) {
    const Vec3 p = skin.position(st);
    const Vec3 to_wall = (locator.closest(p).x - p).normalized();
    halfway.push_back((to_wall + Vec3(0, 1, 0)).normalized());
  }
  for (const double sigma : {2.0, 4.0, 8.0, 16.0})
    if (lay_cut(skin, wall, low_pass(halfway, sigma), rim)) return true;
  // Parallel segments cannot cross.
  Vec3 mean = Vec3::Zero();
  for (const Vec3& d : halfway) mean += d;
  for (const Vec3& d : {mean, Vec3(0, 1, 0)})
    if (lay_cut(skin, wall, std::vector<Vec3>(halfway.size(), d), rim)) return true;
  return false;
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

RimRays walk_rim(const HermiteSheet& skin, const WallSheet& wall, Side side, const Vec2& nipple_st,
                 const RimOptions& options) {
  const ThicknessMap map(skin, wall, 97);
  const Core core = thick_core(map, nipple_st);
  if (!(core.thickest > 20))
    throw input_error("labels: the breast is at most ", core.thickest,
                      " mm thick near its nipple; at least 20 mm are needed; check the chest wall");
  RimRays rays;
  rays.centre = core.centre;
  rays.greatest_thickness_mm = core.thickest;
  rays.least_thickness_mm = options.least_thickness_mm > 0
                                ? options.least_thickness_mm
                                : std::clamp(sternal_thickness(map, side) + 5, 15.0, 30.0);
  // A small breast has less tissue everywhere; the rim must lie well below its thickest part.
  rays.least_thickness_mm = std::min(rays.least_thickness_mm, 0.4 * core.thickest);
  for (int i = 0; i < options.rays; ++i) {
    const double angle = 2 * pi * i / options.rays;
    rays.direction.emplace_back(elementary::cos(angle), elementary::sin(angle));
    const RayEnd end =
        walk(skin, map, core, rays.direction.back(), rays.least_thickness_mm, options);
    rays.radius.push_back(end.radius);
    rays.end.push_back(end.reason);
  }
  return rays;
}

Rim lay_rim(const HermiteSheet& skin, const WallSheet& wall, const RimRays& rays, double wider_mm,
            const RimOptions& options) {
  Rim rim;
  rim.centre = rays.centre;
  rim.end = rays.end;
  rim.least_thickness_mm = rays.least_thickness_mm;
  rim.greatest_thickness_mm = rays.greatest_thickness_mm;
  rim.wider_mm = wider_mm;
  std::vector<double> log_radius;
  for (const double radius : rays.radius) log_radius.push_back(elementary::log(radius));
  log_radius = median_of_five(log_radius);
  // A rim over a dented skin may need more smoothing before a cut can be laid.
  for (const double stronger : {1.0, 2.0, 4.0}) {
    const auto smooth =
        low_pass(log_radius, stronger * options.rays * options.low_pass_degrees / 360);
    rim.skin.clear();
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      const Vec2& way = rays.direction[i];
      const double radius = elementary::exp(smooth[i]),
                   limit = margin_radius(rim.centre, way, options);
      const SheetPoint at = skin.evaluate(rim.centre + std::min(radius, limit) * way);
      const double mm_per_radius = (at.x_s * way.x() + at.x_t * way.y()).norm();
      rim.skin.push_back(rim.centre + std::min(radius + wider_mm / mm_per_radius, limit) * way);
    }
    if (!choose_cut(skin, wall, rim)) continue;
    measure(skin, wall.sheet, rim);
    return rim;
  }
  throw input_error(
      "labels: no straight cut joins the skin's rim to the chest wall without crossing itself; "
      "the wall lies in front of the skin or is too ragged; see segment --chest-wall");
}

}  // namespace breast
