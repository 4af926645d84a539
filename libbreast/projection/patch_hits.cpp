// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/patch_hits.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

// Every loop below is over the lanes and without branches: the compiler makes one vector of it.
unsigned bits(const std::array<double, packet_rays>& flags) {
  unsigned mask = 0;
  for (int k = 0; k < packet_rays; ++k) mask |= unsigned(flags[k] != 0) << k;
  return mask;
}

}  // namespace

void patch_hits(const PatchCorners& p, PatchHits& hits) {
  constexpr double slack = 1e-9;
  alignas(64) std::array<double, packet_rays> first, second;
  PatchHits found;  // nothing the corners could alias
  const Lanes &cx0 = *p.x[0], &cx1 = *p.x[1], &cx2 = *p.x[2], &cx3 = *p.x[3];
  const Lanes &cy0 = *p.y[0], &cy1 = *p.y[1], &cy2 = *p.y[2], &cy3 = *p.y[3];
  for (int k = 0; k < packet_rays; ++k) {
    // p0 + s e + r f + s r g = 0; eliminating s: a r² + b r + c = 0.
    const double x0 = cx0.of[k], y0 = cy0.of[k];
    const double ex = cx1.of[k] - x0, ey = cy1.of[k] - y0;
    const double fx = cx3.of[k] - x0, fy = cy3.of[k] - y0;
    const double gx = cx2.of[k] - cx3.of[k] - ex, gy = cy2.of[k] - cy3.of[k] - ey;
    const double a = fx * gy - fy * gx;
    const double b = x0 * gy - y0 * gx + fx * ey - fy * ex;
    const double c = x0 * ey - y0 * ex;
    const double discriminant = b * b - 4 * a * c;
    const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
    const auto hit = [&](double r, Lanes& s) {  // NaN and infinity (q or a zero) miss
      const double along_x = ex + r * gx, along_y = ey + r * gy;
      const double length2 = along_x * along_x + along_y * along_y;
      s.of[k] = -((x0 + r * fx) * along_x + (y0 + r * fy) * along_y) / length2;
      return int(discriminant >= 0) & int(r >= -slack) & int(r <= 1 + slack) &
             int(s.of[k] >= -slack) & int(s.of[k] <= 1 + slack);
    };
    const double r0 = c / q, r1 = q / a;
    found.r[0].of[k] = r0;
    found.r[1].of[k] = r1;
    first[k] = hit(r0, found.s[0]);
    second[k] = hit(r1, found.s[1]) & int(r1 != r0);
  }
  found.hit = {bits(first), bits(second)};
  hits = found;
}

}  // namespace breast
