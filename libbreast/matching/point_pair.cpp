// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/point_pair.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

// Parameters in [0,1] of the nearest points of segments a0 a1 and b0 b1.
Vec2 nearest_on_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 d = a1 - a0, e = b1 - b0, r = a0 - b0;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const double det = dd * ee - de * de;
  double s = det > 1e-12 * dd * ee ? clamp((de * e.dot(r) - ee * d.dot(r)) / det) : 0.0;
  const double t = ee > 0 ? clamp((de * s + e.dot(r)) / ee) : 0.0;
  if (dd > 0) s = clamp((de * t - d.dot(r)) / dd);
  return {s, t};
}

// Interpolates between two neighbouring points of a column, which lie in one element except for
// rounding at a face.
MaterialPoint between(const ColumnPoint& a, const ColumnPoint& b, double f) {
  if (a.element != b.element) return {f < 0.5 ? a.element : b.element, f < 0.5 ? a.local : b.local};
  return {a.element, a.local + f * (b.local - a.local)};
}

MatchedCurve column(const Matcher& matcher, const Vec2& mark) {
  constexpr double tolerance = 0.01;  // mm
  MatchedCurve curve = matcher.match(mark, tolerance);
  if (curve.in_air()) {
    throw input_error("the mark (", format_fixed(mark.x(), 2), ", ", format_fixed(mark.y(), 2),
                      ") mm in ", view_name(matcher.from_frame().view), " lies in air");
  }
  return curve;
}

}  // namespace

Vec3 PairPoint::position(const HexTopology& mesh, const std::vector<Vec3>& nodal) const {
  return 0.5 * (element_position(mesh, nodal, on_first.element, on_first.local) +
                element_position(mesh, nodal, on_second.element, on_second.local));
}

PairPoint locate_pair(const Matcher& forward, const Matcher& backward, const Vec2& first,
                      const Vec2& second) {
  const MatchedCurve a = column(forward, first), b = column(backward, second);
  PairPoint pair;
  pair.residual = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < a.points.size(); ++i) {
    const ColumnPoint &a0 = a.points[i - 1], &a1 = a.points[i];
    if (a0.stretch != a1.stretch) continue;
    for (std::size_t j = 1; j < b.points.size(); ++j) {
      const ColumnPoint &b0 = b.points[j - 1], &b1 = b.points[j];
      if (b0.stretch != b1.stretch) continue;
      const Vec2 f = nearest_on_segments(a0.imaged, a1.imaged, b0.imaged, b1.imaged);
      const double apart = (a0.imaged + f.x() * (a1.imaged - a0.imaged) - b0.imaged -
                            f.y() * (b1.imaged - b0.imaged))
                               .norm();
      if (!(apart < pair.residual)) continue;
      pair.residual = apart;
      pair.on_first = between(a0, a1, f.x());
      pair.on_second = between(b0, b1, f.y());
    }
  }
  pair.first_to_second = distance_to_curve(a, second);
  pair.second_to_first = distance_to_curve(b, first);
  return pair;
}

void report_spot(const PairPoint& pair, const Matcher& forward, Report& report) {
  const HexMesh &from = forward.from(), &to = forward.to();
  report.set("spot/residual_mm", pair.residual);
  report.set("spot/first_to_second_mm", pair.first_to_second);
  report.set("spot/second_to_first_mm", pair.second_to_first);
  report.set("spot/imaged", pair.position(from, from.imaged));
  if (!from.reference.empty()) report.set("spot/reference", pair.position(from, from.reference));
  report.set("spot/" + view_name(forward.from_frame().view), pair.position(from, from.points));
  report.set("spot/" + view_name(forward.to_frame().view), pair.position(to, to.points));
}

}  // namespace breast
