// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/bias_and_wall.hpp"

#include <algorithm>
#include <cmath>

#include "segment/grid/filters.hpp"
#include "segment/pace.hpp"

namespace breast {

namespace {

constexpr double depth_limit =
    45;  // mm behind the sternal skin: no fat for the first bias estimate
constexpr double wall_clearance = 2;  // mm in front of the wall used for the later ones

/// Bias on a grid halved in plane, and the ratio on the working grid. `limit` gives the depth (mm)
/// per column up to which there may be fat; there is none in `gland` (may be null).
template <class Limit>
void correct_bias(Work& work, bool again, const BiasSettings& settings, const Limit& limit,
                  const MisleadingGland* gland = nullptr) {
  const std::array<int, 3> half{2, 2, 1};
  const Volume<float> coarse = coarsened(work.scan, half);
  Volume<float> distance = resampled(work.skin_distance, coarse.grid);
  Mask allowed(coarse.grid);
  const Grid& grid = coarse.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double depth = limit(std::min(2 * i, work.scan.grid.size[0] - 1), k);
      for (int j = 0; j < grid.size[1]; ++j) {
        allowed.at(i, j, k) =
            distance.at(i, j, k) < 0 && (2 * j + 0.5) * work.scan.grid.spacing[1] < depth;
      }
    }
  }
  DimTissue dim;
  if (gland) {
    constexpr float least_share = 0.1f;
    const Volume<float> share = resampled(gland->share, grid);
    for (std::size_t n = 0; n < share.voxels.size(); ++n)
      if (share.voxels[n] > least_share) allowed.voxels[n] = 0;
    const auto& [compact, step] = gland->compact;
    if (!compact.voxels.empty()) dim = {resampled(compact, grid), step};
  }
  const Volume<float> previous = work.bias.log_bias;
  work.bias = fat_bias(coarse, allowed, distance, settings, again ? &previous : nullptr,
                       dim.share.voxels.empty() ? nullptr : &dim);
  divide_by_bias(work, work.bias);
  work.ratio = within(work.body.mask, work.brightness);
}

}  // namespace

void find_wall(Work& work, Progress& progress, Timer& timer) {
  for (int pass = 0; pass < 2; ++pass) {
    progress.update("chest wall", pass ? stage_begin::second_wall : stage_begin::first_wall,
                    pass ? "second pass" : "first pass");
    {
      const Timer::Scope phase(timer, "bias");
      correct_bias(work, pass > 0, {}, [&](int i, int k) {
        const double sternal = work.torso.cleft[k] + depth_limit;
        if (pass == 0 || std::isnan(work.wall.depth.at(i, k))) return sternal;
        return work.wall.depth.at(i, k) - wall_clearance;
      });
    }
    const Timer::Scope phase(timer, "chest_wall");
    work.wall = find_chest_wall(work.ratio, work.domain, pass ? &work.wall : nullptr);
  }
  const Timer::Scope phase(timer, "chest_wall");
  snap_chest_wall(work.wall, work.ratio, work.domain);
}

void refine_bias(Work& work, const MisleadingGland* gland) {
  correct_bias(
      work, true, {.refined = true},
      [&](int i, int k) {
        return std::isnan(work.wall.depth.at(i, k)) ? work.torso.cleft[k] + 10
                                                    : work.wall.depth.at(i, k) - wall_clearance;
      },
      gland);
}

}  // namespace breast
