// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/band_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breast {

namespace {

// Unit vector across each piece of the line, to its left; of a piece without length that of the one before.
std::vector<Vec2> normals(const BandLine& line) {
  std::vector<Vec2> normals;
  Vec2 normal(1, 0);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 along = line[i].uv - line[i - 1].uv;
    if (along.norm() > 1e-6) normal = Vec2(-along.y(), along.x()).normalized();
    normals.push_back(normal);
  }
  return normals;
}

Vec2 shifted(const BandPoint& point, const Vec2& normal, double width) {
  return point.uv + width * point.deviation * normal;
}

// From one normal to the next about the outside of a corner; on its inside the one between them.
std::vector<Vec2> about_corner(const Vec2& before, const Vec2& after, double side) {
  constexpr double step = std::numbers::pi / 18;
  const double turn =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  if (side * turn > 0) {
    const Vec2 between = before + after;
    return {side * (between.norm() > 1e-9 ? Vec2(between.normalized()) : before)};
  }
  const int steps = 1 + int(std::abs(turn) / step);
  std::vector<Vec2> found;
  for (int k = 0; k <= steps; ++k) {
    const double angle = turn * k / steps, c = std::cos(angle), s = std::sin(angle);
    found.push_back(side * Vec2(c * before.x() - s * before.y(), s * before.x() + c * before.y()));
  }
  return found;
}

// Nearer to some point of the line than the band is wide there, by more than its points' distances make.
bool covered(const Vec2& place, const BandLine& line, double width) {
  constexpr double inside = 0.97;
  return std::any_of(line.begin(), line.end(), [&](const BandPoint& point) {
    return (place - point.uv).norm() < inside * width * point.deviation;
  });
}

// The line with the mean of its variance over 5 mm to either side: it jumps from element to element.
BandLine smoothed(const BandLine& line) {
  constexpr double reach = 5;  // mm
  std::vector<double> along{0};
  for (std::size_t i = 1; i < line.size(); ++i)
    along.push_back(along.back() + (line[i].uv - line[i - 1].uv).norm());
  BandLine smoothed = line;
  for (std::size_t i = 0; i < line.size(); ++i) {
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const double near = reach - std::abs(along[k] - along[i]);
      if (near <= 0) continue;
      const double length = along[std::min(k + 1, line.size() - 1)] - along[k > 0 ? k - 1 : 0];
      const double weight = near * (length + 1e-6);
      sum += weight * line[k].deviation * line[k].deviation;
      weights += weight;
    }
    smoothed[i].deviation = std::sqrt(sum / weights);
  }
  return smoothed;
}

}  // namespace

std::vector<BandLine> stretches_of(const MatchedCurve& curve, const Band& band) {
  std::vector<BandLine> lines;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i == 0 || curve.points[i - 1].stretch != curve.points[i].stretch) lines.emplace_back();
    lines.back().push_back(band.points[i]);
  }
  for (BandLine& line : lines) line = smoothed(line);
  return lines;
}

BandLine drawn_points(const MatchedCurve& curve, const Band& band) {
  BandLine points;
  for (const BandLine& line : stretches_of(curve, band))
    points.insert(points.end(), line.begin(), line.end());
  return points;
}

std::vector<std::vector<Vec2>> band_edges(const BandLine& line, double width) {
  constexpr double deep = 0.8;  // of the width: what is nearer to the curve is no edge
  const std::vector<Vec2> across = normals(line);
  std::vector<std::vector<Vec2>> edges;
  for (const double side : {-1.0, 1.0}) {
    edges.emplace_back();
    bool hidden = false;
    for (std::size_t i = 0; i < line.size() && !across.empty(); ++i) {
      const Vec2 &before = across[i > 0 ? i - 1 : 0],
                 &after = across[std::min(i, across.size() - 1)];
      for (const Vec2& normal : about_corner(before, after, side)) {
        const Vec2 place = shifted(line[i], normal, width);
        if (covered(place, line, width)) {
          hidden = true;
          continue;
        }
        if (hidden && !edges.back().empty() &&
            covered(0.5 * (place + edges.back().back()), line, deep * width))
          edges.emplace_back();
        hidden = false;
        edges.back().push_back(place);
      }
    }
  }
  std::erase_if(edges, [](const auto& edge) { return edge.size() < 2; });
  return edges;
}

std::vector<std::array<Vec2, 4>> band_pieces(const BandLine& line, double width) {
  const std::vector<Vec2> across = normals(line);
  std::vector<std::array<Vec2, 4>> pieces;
  for (std::size_t i = 0; i < across.size(); ++i) {
    const BandPoint &a = line[i], &b = line[i + 1];
    const Vec2& n = across[i];
    pieces.push_back(
        {shifted(a, n, width), shifted(b, n, width), shifted(b, -n, width), shifted(a, -n, width)});
    for (const double side : {-1.0, 1.0}) {
      const std::vector<Vec2> about = about_corner(across[i > 0 ? i - 1 : 0], n, side);
      for (std::size_t k = 1; k < about.size(); ++k) {
        const Vec2 corner = shifted(a, about[k], width);
        pieces.push_back({a.uv, shifted(a, about[k - 1], width), corner, corner});
      }
    }
  }
  return pieces;
}

}  // namespace breast
