// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/rim_border.hpp"

#include <array>
#include <cmath>

namespace breast {

std::string_view border_name(RimBorder border) {
  constexpr std::array<std::string_view, n_rim_borders> names = {"medial", "superior", "lateral",
                                                                 "inferior"};
  return names[std::size_t(border)];
}

std::vector<RimBorder> rim_borders(const std::vector<Vec3>& rim, Side side) {
  std::vector<RimBorder> borders;
  if (rim.empty()) return borders;
  Vec3 low = rim[0], high = rim[0];
  for (const Vec3& p : rim) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  for (const Vec3& p : rim) {
    const double lateral = lateral_sign(side) * (p.x() - middle.x()) / half.x(),
                 up = (p.z() - middle.z()) / half.z();
    if (std::abs(lateral) >= std::abs(up)) {
      borders.push_back(lateral > 0 ? RimBorder::lateral : RimBorder::medial);
    } else {
      borders.push_back(up > 0 ? RimBorder::superior : RimBorder::inferior);
    }
  }
  return borders;
}

std::vector<RimBorder> rim_borders(const BreastGeometry& geometry) {
  std::vector<Vec3> rim;
  for (const Vec2& st : geometry.rim_skin) rim.push_back(geometry.skin.position(st));
  return rim_borders(rim, geometry.side);
}

}  // namespace breast
