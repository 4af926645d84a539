// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/chest_wall.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "segment/wall/cut_columns.hpp"
#include "segment/wall/legendre_surface.hpp"
#include "segment/wall/min_cut.hpp"
#include "segment/wall/wall_cost.hpp"

namespace breast {

namespace {

/// Brightness of muscle: median ratio 2-8 mm behind the surface.
double muscle_behind(const Volume<float>& ratio, const WallDomain& domain,
                     const HeightField& depth) {
  std::vector<float> values;
  const double step = ratio.grid.spacing[1];
  for (int k = 0; k < depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (std::isnan(depth.at(i, k)) || std::isnan(domain.skin.at(i, k))) continue;
      const int from = int(std::ceil((depth.at(i, k) + 2) / step)),
                to = int((depth.at(i, k) + 8) / step);
      for (int j = from; j <= std::min(to, ratio.grid.size[1] - 1); ++j)
        values.push_back(ratio.at(i, j, k));
    }
  }
  if (values.empty()) return 0.35;
  return std::clamp(median(std::move(values)), 0.05, 0.75);
}

Levels search_levels(const WallDomain& domain, const Grid& grid) {
  const double nearest = *std::min_element(domain.nearest.begin(), domain.nearest.end());
  const double deepest =
      *std::max_element(domain.deepest.depth.begin(), domain.deepest.depth.end());
  Levels levels;
  levels.first = std::max(0, int(nearest / grid.spacing[1]));
  levels.count = std::min(grid.size[1] - 1, int(deepest / grid.spacing[1])) - levels.first + 1;
  if (levels.count < 3) throw input_error("the scan ends in front of the chest wall");
  return levels;
}

/// Those of `all` within `band_reach` of a surface found before.
Levels near_surface(const Levels& all, double depth, double spacing) {
  constexpr double band_reach = 25;  // mm
  const int middle =
                std::clamp(int(std::lround(depth / spacing)), all.first, all.first + all.count - 1),
            reach = int(band_reach / spacing);
  Levels near;
  near.first = std::max(all.first, middle - reach);
  near.count = std::min(all.first + all.count - 1, middle + reach) - near.first + 1;
  return near;
}

/// The smoothness of the surface is that of an area integral of its slope: the same whatever the
/// distance of columns and slices.
void set_smoothness(SurfaceProblem& problem, double across, double along, double level) {
  constexpr double slope_cost_x = 0.08, slope_cost_z = 0.06;
  constexpr double steepest_x = 2, steepest_z = 1.25;
  problem.step_cost_x = slope_cost_x * level / across;
  problem.step_cost_z = slope_cost_z * level / along;
  problem.max_step_x = std::max(2, int(steepest_x * across / level));
  problem.max_step_z = std::max(2, int(steepest_z * along / level));
}

/// `before` (may be null) is a surface from
/// which this one is not far.
HeightField cut_surface(const Volume<float>& ratio, const WallDomain& domain,
                        const HeightField* prior, double muscle, const HeightField* before) {
  const Grid& grid = ratio.grid;
  const Levels all = search_levels(domain, grid);
  const CutColumns columns(domain, grid.spacing[0]);
  SurfaceProblem problem;
  problem.nx = columns.count;
  problem.nz = grid.size[2];
  set_smoothness(problem, columns.stride * grid.spacing[0], grid.spacing[2], grid.spacing[1]);
  std::vector<Levels> levels;
  problem.first = {0};
  for (int k = 0; k < problem.nz; ++k) {
    for (int c = 0; c < problem.nx; ++c) {
      const int i = columns.at(c, domain);
      levels.push_back(before ? near_surface(all, before->at(i, k), grid.spacing[1]) : all);
      problem.top.push_back(levels.back().first);
      problem.first.push_back(problem.first.back() + std::size_t(levels.back().count));
    }
  }
  problem.cost.resize(problem.first.back());
#pragma omp parallel for
  for (int k = 0; k < problem.nz; ++k) {
    for (int c = 0; c < problem.nx; ++c) {
      const int column = k * problem.nx + c;
      column_cost(ratio, domain, prior, muscle, levels[column], columns.at(c, domain), k,
                  &problem.cost[problem.first[column]]);
    }
  }
  const std::vector<int> surface = optimal_surface(problem);
  HeightField depth(grid.size[0], problem.nz, no_depth);
  for (int k = 0; k < problem.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      depth.at(i, k) = (columns.between(surface, i, k, domain) - 0.5) * grid.spacing[1];
    }
  }
  return depth;
}

HeightField confidence_of(const Volume<float>& ratio, const WallDomain& domain,
                          const HeightField& depth, double muscle) {
  HeightField confidence(depth.nx, depth.nz, 0);
  const double step = ratio.grid.spacing[1];
#pragma omp parallel for
  for (int k = 0; k < depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (std::isnan(domain.skin.at(i, k))) continue;
      const Windows windows(column_profile(ratio, i, k), muscle, step);
      const int j = int(std::lround(depth.at(i, k) / step + 0.5));
      double value = std::clamp((windows.front(j) - windows.behind(j)) / 0.6, 0.0, 1.0);
      const double to_limit =
          std::min(domain.deepest.at(i, k) - depth.at(i, k), depth.at(i, k) - domain.nearest[k]);
      if (to_limit < 3) value *= 0.3;  // held by the search range, not by the image
      confidence.at(i, k) = value;
    }
  }
  return confidence;
}

}  // namespace

namespace {

/// The last row in which a voxel of slice k has data. One for all columns of a slice: of a body that is rolled one
/// way or the other, the same part shows the wall, and where a corner of the view is cut the wall is continued. Not one
/// for all slices: in a body that is pitched, the view ends elsewhere in each. That of the grid where the slice has none.
int last_seen_row(const Grid& grid, const Mask& seen, int k) {
  const int end = grid.size[1] - 1;
  if (seen.voxels.empty()) return end;
  const auto in_row = [&](int j) {
    for (int i = 0; i < grid.size[0]; ++i)
      if (seen.at(i, j, k)) return true;
    return false;
  };
  int last = end;
  while (last >= 0 && !in_row(last)) --last;
  return last < 0 ? end : last;
}

}  // namespace

WallDomain wall_domain(const Mask& body, const TorsoFront& torso, bool left, const Mask& seen) {
  WallDomain domain;
  domain.left = left;
  const Grid& grid = body.grid;
  const int across = int(25 / grid.spacing[0]);
  domain.first = left ? std::max(0, torso.midline - across) : 0;
  domain.last = left ? grid.size[0] - 1 : std::min(grid.size[0] - 1, torso.midline + across);
  domain.deepest = HeightField(grid.size[0], grid.size[2], 0);
  for (int k = 0; k < grid.size[2]; ++k) {
    const double end = last_seen_row(grid, seen, k) * grid.spacing[1];
    domain.nearest.push_back(std::max(0.0, torso.cleft[k] - 25));
    for (int i = 0; i < grid.size[0]; ++i) {
      const double aside = std::abs(i - torso.midline) * grid.spacing[0];
      const double depth = sought_behind + 0.5 * std::clamp(aside - curving_back, 0.0, 50.0);
      domain.deepest.at(i, k) = std::min(end, torso.cleft[k] + depth);
    }
  }
  domain.skin = HeightField(grid.size[0], grid.size[2], no_depth);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const int deep = std::min(grid.size[1] - 1, int(domain.deepest.at(i, k) / grid.spacing[1]));
      int j = deep;
      while (j >= 0 && body.at(i, j, k)) --j;
      if (j < deep) domain.skin.at(i, k) = (j + 0.5) * grid.spacing[1];
    }
  }
  // Trim columns without any body (air beside the patient).
  const auto empty = [&](int i) {
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int j = 0; j * grid.spacing[1] <= domain.deepest.at(i, k); ++j)
        if (body.at(i, j, k)) return false;
    }
    return true;
  };
  while (domain.first < domain.last && empty(domain.first)) ++domain.first;
  while (domain.last > domain.first && empty(domain.last)) --domain.last;
  if (domain.last - domain.first < 8)
    throw input_error("no body on the ", left ? "left" : "right", " side");
  return domain;
}

ChestWall find_chest_wall(const Volume<float>& ratio, const WallDomain& domain,
                          const ChestWall* start) {
  ChestWall wall;
  wall.muscle_ratio = start ? start->muscle_ratio : 0.35;
  std::optional<HeightField> prior;
  if (start) prior = legendre_surface(start->depth, start->confidence, domain);
  std::optional<HeightField> before;
  if (start) before = start->depth;
  for (int round = 0; round < 3; ++round) {
    wall.depth = cut_surface(ratio, domain, prior ? &*prior : nullptr, wall.muscle_ratio,
                             before ? &*before : nullptr);
    before = wall.depth;
    wall.muscle_ratio = muscle_behind(ratio, domain, wall.depth);
    wall.confidence = confidence_of(ratio, domain, wall.depth, wall.muscle_ratio);
    prior = legendre_surface(wall.depth, wall.confidence, domain);
  }
  return wall;
}

namespace {

/// Weighted 3 x 3 mean of `moved` (weights: confidence), leaving columns of the domain only.
HeightField smoothed(const HeightField& depth, const HeightField& weight,
                     const WallDomain& domain) {
  HeightField out = depth;
  for (int k = 0; k < depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      double sum = 0, total = 0;
      for (int c = std::max(k - 1, 0); c <= std::min(k + 1, depth.nz - 1); ++c) {
        for (int a = std::max(i - 1, domain.first); a <= std::min(i + 1, domain.last); ++a) {
          const double w = (0.05 + weight.at(a, c)) * (a == i ? 2 : 1) * (c == k ? 4 : 1);
          sum += w * depth.at(a, c);
          total += w;
        }
      }
      out.at(i, k) = sum / total;
    }
  }
  return out;
}

HeightField median_filtered(const HeightField& depth, const WallDomain& domain) {
  HeightField out = depth;
  for (int k = 0; k < depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      std::vector<float> near;
      for (int c = std::max(k - 1, 0); c <= std::min(k + 1, depth.nz - 1); ++c) {
        for (int a = std::max(i - 2, domain.first); a <= std::min(i + 2, domain.last); ++a) {
          near.push_back(float(depth.at(a, c)));
        }
      }
      const double middle = median(std::move(near));
      if (std::abs(depth.at(i, k) - middle) > 2) out.at(i, k) = middle;
    }
  }
  return out;
}

/// Nearest bright-to-dark crossing of `level` within `reach` mm; no_depth when there is none.
double nearest_crossing(const std::vector<float>& profile, double step, double from, double level,
                        double reach) {
  double best = no_depth;
  const int low = std::max(1, int((from - reach) / step)),
            high = std::min(int(profile.size()) - 1, int((from + reach) / step) + 1);
  for (int j = low; j <= high; ++j) {
    const double a = profile[j - 1], b = profile[j];
    if (!(a >= level && b < level)) continue;
    const double depth = (j - 1 + (a - level) / (a - b)) * step;
    if (std::abs(depth - from) > reach) continue;
    if (std::isnan(best) || std::abs(depth - from) < std::abs(best - from)) best = depth;
  }
  return best;
}

}  // namespace

void snap_chest_wall(ChestWall& wall, const Volume<float>& ratio, const WallDomain& domain) {
  const double level = 0.5 * (1 + wall.muscle_ratio), step = ratio.grid.spacing[1];
  HeightField moved = wall.depth;
#pragma omp parallel for
  for (int k = 0; k < moved.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      const double crossing =
          nearest_crossing(column_profile(ratio, i, k), step, wall.depth.at(i, k), level, 3.0);
      if (std::isnan(crossing)) {
        wall.confidence.at(i, k) *= 0.5;
      } else {
        moved.at(i, k) = crossing;
      }
    }
  }
  wall.depth = smoothed(median_filtered(moved, domain), wall.confidence, domain);
}

}  // namespace breast
