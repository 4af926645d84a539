// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/shapes/plane_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "figures/shapes/contour_lines.hpp"

namespace breast {

namespace {

constexpr double section_raster_mm = 0.5;
/// Length in raster pixels of a piece of outline; shorter pieces would be drawn as a row of dots.
constexpr int thinning = 3;
constexpr int border = 12;  // pixels round the raster

void fill_triangle(PlaneField& field, const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto across = [](const Vec2& p, const Vec2& q) { return p.x() * q.y() - p.y() * q.x(); };
  const double area = across(b - a, c - a);
  if (area == 0) return;
  const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  for (int row = int(std::ceil(low.y())); row <= int(high.y()); ++row) {
    for (int column = int(std::ceil(low.x())); column <= int(high.x()); ++column) {
      const Vec2 p(column, row);
      const double u = across(b - p, c - p) / area, v = across(c - p, a - p) / area;
      if (u >= 0 && v >= 0 && u + v <= 1) field.at(column, row) = 1;
    }
  }
}

PlaneField thinned(const PlaneField& field) {
  PlaneField out(1 + (field.width - 1) / thinning, 1 + (field.height - 1) / thinning,
                 thinning * field.pixel);
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      out.at(column, row) = field.at(thinning * column, thinning * row);
    }
  }
  return out;
}

}  // namespace

std::vector<std::array<Vec3, 2>> plane_section(const Facets& facets, const Vec3& normal,
                                               double offset) {
  std::vector<std::array<Vec3, 2>> segments;
  const auto cut = [&](int i, int j, int k) {
    std::vector<Vec3> ends;
    const std::array<int, 3> corner{i, j, k};
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 &a = facets.points[std::size_t(corner[c])],
                 &b = facets.points[std::size_t(corner[(c + 1) % 3])];
      const double above_a = a.dot(normal) - offset, above_b = b.dot(normal) - offset;
      if ((above_a > 0) == (above_b > 0)) continue;
      ends.push_back(a + above_a / (above_a - above_b) * (b - a));
    }
    if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
  };
  for (const auto& quad : facets.quads) {
    cut(quad[0], quad[1], quad[2]);
    if (quad[3] != quad[2]) cut(quad[0], quad[2], quad[3]);
  }
  return segments;
}

std::vector<std::array<Vec3, 2>> silhouette(const Facets& facets, const Vec3& direction,
                                            const Vec3& up, const Vec3& depth) {
  if (facets.quads.empty()) return {};
  const Vec3 forward = direction.normalized(), right = forward.cross(up).normalized(),
             top = right.cross(forward);
  std::vector<Vec2> flat;
  Vec2 low = Vec2::Constant(1e300), high = -low;
  for (const Vec3& x : facets.points) {
    flat.emplace_back(x.dot(right), x.dot(top));
    low = low.cwiseMin(flat.back());
    high = high.cwiseMax(flat.back());
  }
  const Vec2 size = (high - low) / section_raster_mm;
  PlaneField field(int(size.x()) + 2 * border, int(size.y()) + 2 * border, section_raster_mm);
  for (Vec2& p : flat) p = (p - low) / section_raster_mm + Vec2::Constant(border);
  for (const auto& q : facets.quads) {
    fill_triangle(field, flat[std::size_t(q[0])], flat[std::size_t(q[1])], flat[std::size_t(q[2])]);
    fill_triangle(field, flat[std::size_t(q[0])], flat[std::size_t(q[2])], flat[std::size_t(q[3])]);
  }
  const Vec2 corner = low - Vec2::Constant(border * section_raster_mm);
  const auto lifted = [&](const Vec2& mm) {
    const Vec2 p = corner + mm;
    return Vec3(p.x() * right + p.y() * top + depth.dot(forward) * forward);
  };
  std::vector<std::array<Vec3, 2>> lines;
  for (const auto& [a, b] :
       contour_lines(thinned(smoothed(field, thinning * section_raster_mm)), 0.5)) {
    // Drawn a little longer than they are, because wide lines leave gaps where pieces only touch.
    const Vec2 more = 0.15 * section_raster_mm * (b - a).stableNormalized();
    lines.push_back({lifted(a - more), lifted(b + more)});
  }
  return lines;
}

}  // namespace breast
