// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/wall_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "segment/grid/filters.hpp"
#include "segment/wall/wall_cost.hpp"

namespace breast {

namespace {

constexpr double level_reach = 12;   // mm
constexpr double temperature = 0.1;  // of the cost: contrast between fat and muscle is about 1
constexpr double hand_sigma = 1;     // mm: a careful click

double column_sigma(const Volume<float>& ratio, const WallDomain& domain, const ChestWall& wall,
                    int i, int k) {
  const double step = ratio.grid.spacing[1], depth = wall.depth.at(i, k);
  Levels levels;
  levels.first = std::max(0, int((depth - level_reach) / step));
  levels.count =
      std::min(ratio.grid.size[1] - 1, int((depth + level_reach) / step)) - levels.first + 1;
  if (levels.count < 2) return level_reach;
  std::vector<float> cost(levels.count);
  column_cost(ratio, domain, nullptr, wall.muscle_ratio, levels, i, k, cost.data());
  const float least = *std::min_element(cost.begin(), cost.end());
  double total = 0, square = step * step / 12;
  double moment = 0;
  for (int d = 0; d < levels.count; ++d) {
    const double weight = elementary::exp(-(cost[d] - least) / temperature);
    const double away = (levels.first + d - 0.5) * step - depth;
    total += weight;
    moment += weight * away * away;
  }
  square += moment / total;
  return std::sqrt(square);
}

/// The spread of the weights as a standard deviation. Where the image is clear the whole surface is
/// surer than a column of it, where it is not the cost knows too few of the places a wall may have.
/// The factors are those with which 90 % of true walls lie in their 90 % band (docs/validation).
double calibrated(double spread, double confidence) {
  constexpr double clear = 0.5, unclear = 1.8, slope = 1.45;
  return spread * std::max(clear, unclear - slope * confidence);
}

}  // namespace

HeightField wall_sigma(const Volume<float>& ratio, const WallDomain& domain,
                       const ChestWall& wall) {
  const Grid& grid = ratio.grid;
  Grid plane = grid;
  plane.size = {grid.size[0], 1, grid.size[2]};
  Volume<float> sigma(plane), weight(plane);
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!std::isfinite(wall.depth.at(i, k)) || std::isnan(domain.skin.at(i, k))) continue;
      sigma.at(i, 0, k) =
          float(calibrated(column_sigma(ratio, domain, wall, i, k), wall.confidence.at(i, k)));
      weight.at(i, 0, k) = 1;
    }
  }
  sigma = gaussian(sigma, 8);
  weight = gaussian(weight, 8);
  HeightField out(wall.depth.nx, wall.depth.nz, level_reach);
  for (int k = 0; k < out.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (weight.at(i, 0, k) > 1e-3f) out.at(i, k) = sigma.at(i, 0, k) / weight.at(i, 0, k);
    }
  }
  return out;
}

void hand_set_sigma(ChestWall& after, const HeightField& before) {
  for (std::size_t n = 0; n < before.depth.size(); ++n) {
    if (std::abs(after.depth.depth[n] - before.depth[n]) > 0.25)
      after.sigma.depth[n] = std::min(after.sigma.depth[n], hand_sigma);
  }
}

void shift_wall(ChestWall& wall, const WallDomain& domain, double sigmas) {
  constexpr double below_skin = 3;  // mm
  for (int k = 0; k < wall.depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      double& depth = wall.depth.at(i, k);
      const double moved = depth + sigmas * wall.sigma.at(i, k), skin = domain.skin.at(i, k);
      depth = std::isnan(skin) ? moved : std::max(moved, std::min(depth, skin + below_skin));
    }
  }
}

}  // namespace breast
