// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/rim_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"
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

/// What a ray passes, in equal steps of its parameter.
struct Profile {
  double limit = 0;               ///< radius at the last step
  std::vector<double> arc;        ///< mm along the skin
  std::vector<double> thickness;  ///< mm of tissue
  std::vector<double> share;      ///< of the labelled breast

  int steps() const { return int(arc.size()) - 1; }
  double radius(int k) const { return limit * k / steps(); }
  /// Sine of the angle between skin and wall around step k.
  double thinning(int k) const {
    constexpr double window = 10;  // mm
    int a = k, b = k;
    while (a > 0 && arc[k] - arc[a] < window / 2) --a;
    while (b < steps() && arc[b] - arc[k] < window / 2) ++b;
    return -(thickness[b] - thickness[a]) / (arc[b] - arc[a]);
  }
  /// The step at which the labelled breast ends: from there on, and for 10 mm, most of what lies below
  /// the skin is something else. The number of steps if it does not end.
  int border() const {
    constexpr double for_mm = 10;
    int first = steps();
    for (int k = steps(); k >= 0; --k) {
      if (share[k] >= 0.5) continue;
      int next = k;
      while (next < steps() && share[next] < 0.5 && arc[next] - arc[k] < for_mm) ++next;
      if (share[next] < 0.5) first = k;
    }
    return first;
  }
};

Profile profile_of(const HermiteSheet& skin, const ThicknessMap& map, const BreastShare& share,
                   const Vec2& centre, const Vec2& direction, const RayOptions& options) {
  constexpr double step = 0.004;
  Profile profile;
  profile.limit = margin_radius(centre, direction, options.margin);
  const int steps = std::max(2, int(profile.limit / step));
  Vec3 last;
  for (int k = 0; k <= steps; ++k) {
    const Vec2 st = centre + direction * (profile.limit * k / steps);
    const SheetPoint at = skin.evaluate(st);
    profile.arc.push_back(k == 0 ? 0 : profile.arc.back() + (at.x - last).norm());
    profile.thickness.push_back(map.at(st));
    profile.share.push_back(share.below(at));
    last = at.x;
  }
  return profile;
}

struct RayEnd {
  int step;
  RimEnd reason;
};

/// From the border of the labels outwards, to where the skin is no longer steep.
RayEnd end_of(const Profile& profile, int border, double thin, const RayOptions& options) {
  const double steep = elementary::sin(options.steep_degrees * pi / 180);
  for (int k = 1; k < profile.steps(); ++k) {
    if (!(profile.thickness[k] >= options.least_cut_mm)) return {k, RimEnd::thin_tissue};
    if (k < border) continue;
    const bool flat = profile.thinning(k) < steep || profile.thickness[k] < 0.6 * thin;
    if (flat || profile.arc[k] - profile.arc[border] >= options.farthest_mm)
      return {k, profile.thickness[k] < thin ? RimEnd::thin_tissue : RimEnd::slope};
  }
  return {profile.steps(), RimEnd::margin};
}

}  // namespace

BreastShare::BreastShare(const LabelVolume& labels, const Box& box)
    : breast_(labels, box, smoothing_mm, is_breast), soft_(labels, box, smoothing_mm, [](Tissue t) {
        return t != Tissue::air && t != Tissue::muscle;
      }) {}

double BreastShare::below(const SheetPoint& skin) const {
  constexpr double depth = 4, least_soft = 0.05;  // mm; share of soft tissue that can be judged
  const Vec3 p = skin.x - depth * skin.normal();
  const double soft = soft_.value(p);
  return soft < least_soft ? 0 : breast_.value(p) / soft;
}

double margin_radius(const Vec2& centre, const Vec2& direction, const SheetMargin& margin) {
  double low = 0, high = 1.5;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (within_margin(centre + middle * direction, margin) ? low : high) = middle;
  }
  return low;
}

RimRays walk_rim(const HermiteSheet& skin, const WallSheet& wall, const BreastShare& share,
                 Side side, const Vec2& nipple_st, const RayOptions& options) {
  const ThicknessMap map(skin, wall, 97);
  const Core core = thick_core(map, nipple_st);
  if (!(core.thickest > 20))
    throw input_error("labels: the breast is at most ", core.thickest,
                      " mm thick near its nipple; at least 20 mm are needed; check the chest wall");
  RimRays rays;
  rays.centre = core.centre;
  rays.greatest_thickness_mm = core.thickest;
  // A small breast has less tissue everywhere.
  const double thin =
      std::min(std::clamp(sternal_thickness(map, side) + 5, 15.0, 30.0), 0.4 * core.thickest);
  for (int i = 0; i < options.rays; ++i) {
    const double angle = 2 * pi * i / options.rays;
    rays.direction.emplace_back(elementary::cos(angle), elementary::sin(angle));
    const Profile profile =
        profile_of(skin, map, share, core.centre, rays.direction.back(), options);
    const int border = profile.border();
    const RayEnd end = end_of(profile, border, thin, options);
    rays.border.push_back(profile.radius(border));
    rays.radius.push_back(profile.radius(end.step));
    rays.end.push_back(end.reason);
  }
  return rays;
}

}  // namespace breast
