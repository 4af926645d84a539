// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/wall_cost.hpp"

namespace breast {

namespace {

constexpr double skin_margin = 6;  // mm below the skin where no wall is
// mm from the prior that are free, cost a mm beyond
constexpr double prior_free = 6, prior_cost = 0.03;

}  // namespace

std::vector<float> column_profile(const Volume<float>& ratio, int i, int k) {
  const auto& size = ratio.grid.size;
  std::vector<float> profile(size[1], 0);
  int count = 0;
  for (int c = std::max(k - 1, 0); c <= std::min(k + 1, size[2] - 1); ++c) {
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, size[0] - 1); ++a) {
      for (int j = 0; j < size[1]; ++j) profile[j] += ratio.at(a, j, c);
      ++count;
    }
  }
  for (float& value : profile) value /= float(count);
  return profile;
}

void column_cost(const Volume<float>& ratio, const WallDomain& domain, const HeightField* prior,
                 double muscle, const Levels& levels, int i, int k, float* cost) {
  const double step = ratio.grid.spacing[1], skin = domain.skin.at(i, k);
  const Windows windows(column_profile(ratio, i, k), muscle, step);
  for (int d = 0; d < levels.count; ++d) {
    const int j = levels.first + d;
    const double depth = (j - 0.5) * step;
    double c = 0;
    if (!std::isnan(skin)) {
      c = windows.behind(j) - windows.front(j) - std::clamp(windows.drop(j), -0.5, 1.0);
      if (depth < skin + skin_margin) c += 3;
    }
    if (depth < domain.nearest[k] || depth > domain.deepest.at(i, k)) c += 5;
    if (prior) c += prior_cost * std::max(0.0, std::abs(depth - prior->at(i, k)) - prior_free);
    cost[d] = float(c);
  }
}

}  // namespace breast
