// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast/dixon.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "segment/grid/filters.hpp"

namespace breast {

namespace {

// Brightness of the sum, and share of fat, midway between fat and tissue that holds water.
constexpr float middle_sum = 0.78f, middle_share = 0.5f;

/// Positive where share and sum say the same.
Volume<float> agreement(const Work& work) {
  Volume<float> same(work.scan.grid);
  for (std::size_t n = 0; n < same.voxels.size(); ++n) {
    const float sum = std::min(work.brightness.voxels[n], 1.2f) - middle_sum;
    if (work.body.mask.voxels[n]) same.voxels[n] = sum * (work.fat_share.voxels[n] - middle_share);
  }
  return same;
}

/// Median share of fat behind the wall.
double behind_wall(const Work& work, const Volume<float>& share) {
  constexpr double nearest = 2, farthest = 8;  // mm
  std::vector<float> values;
  const Grid& grid = share.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double behind = j * grid.spacing[1] - work.wall.depth.at(i, k);
        if (behind > nearest && behind < farthest) values.push_back(share.at(i, j, k));
      }
    }
  }
  return median(std::move(values), 0);
}

/// Brightness of gland in the sum, relative to fat.
double gland_brightness(const Work& work, const Volume<float>& share) {
  constexpr float most_fat = 0.25f;
  constexpr double usual = 0.45, least = 0.2, most = 0.9;
  std::vector<float> values;
  for (std::size_t n = 0; n < share.voxels.size(); ++n)
    if (work.breast.voxels[n] && share.voxels[n] < most_fat)
      values.push_back(work.brightness.voxels[n]);
  return std::clamp(median(std::move(values), usual), least, most);
}

/// Share of fat in the volume of a voxel from that in its signal, of which gland gives `gland`
/// times as much as fat.
double fat_volume(double of_signal, double gland) {
  constexpr double most = 1.05;  // noise
  const double share = std::clamp(of_signal, 0.0, most);
  return share * gland / (1 - share + share * gland);
}

}  // namespace

Dixon dixon_images(const Volume<float>& water, const Volume<float>& fat) {
  constexpr double same = 0.01;  // mm
  const Grid &a = water.grid, &b = fat.grid;
  const Vec3 last(a.size[0] - 1, a.size[1] - 1, a.size[2] - 1);
  if (a.size != b.size || (a.origin - b.origin).norm() > same ||
      (a.to_patient(last) - b.to_patient(last)).norm() > same) {
    throw input_error("the fat image has ", b.size[0], " x ", b.size[1], " x ", b.size[2],
                      " voxels from (", b.origin.transpose(), ") mm, the water image ", a.size[0],
                      " x ", a.size[1], " x ", a.size[2], " from (", a.origin.transpose(),
                      "): give the two images of one Dixon scan");
  }
  Dixon dixon{Volume<float>(a), Volume<float>(a)};
  for (std::size_t n = 0; n < water.voxels.size(); ++n) {
    const float w = std::max(0.0f, water.voxels[n]), f = std::max(0.0f, fat.voxels[n]);
    dixon.sum.voxels[n] = w + f;
    dixon.fat_share.voxels[n] = w + f > 0 ? f / (w + f) : 0;
  }
  return dixon;
}

FatShare fat_share_of(const Work& work) {
  constexpr double region = 5;                        // mm
  constexpr float contradiction = -0.04f;             // of agreement
  constexpr float surely_fat = 0.9f, darkest = 0.5f;  // of the sum
  constexpr double least_in_fat = 0.7, most_in_muscle = 0.35;
  const Volume<float> same = agreement(work), around = gaussian(same, region);
  FatShare found{Volume<float>(work.scan.grid)};
  std::vector<float> in_fat;
  double exchanged = 0, breast = 0;
  for (std::size_t n = 0; n < same.voxels.size(); ++n) {
    if (!work.body.mask.voxels[n]) continue;
    const bool turned = around.voxels[n] < 0;
    const float own = work.fat_share.voxels[n], sum = work.brightness.voxels[n];
    float& share = found.ratio.voxels[n] = turned ? 1 - own : own;
    if ((turned ? -1 : 1) * same.voxels[n] < contradiction)
      share = std::clamp((sum - darkest) / (1 - darkest), 0.0f, 1.0f);
    breast += work.breast.voxels[n];
    exchanged += work.breast.voxels[n] && turned;
    if (work.breast.voxels[n] && sum > surely_fat) in_fat.push_back(share);
  }
  found.exchanged = breast > 0 ? exchanged / breast : 0;
  const double of_fat = median(in_fat, 0), of_muscle = behind_wall(work, found.ratio);
  if (!(of_fat > least_in_fat && of_muscle < most_in_muscle)) {
    throw input_error("the two images are not water and fat of one scan: fat holds ",
                      std::lround(100 * of_fat), " % of the signal in fat (more than ",
                      std::lround(100 * least_in_fat), " expected), ", std::lround(100 * of_muscle),
                      " % behind the chest wall (less than ", std::lround(100 * most_in_muscle),
                      ")");
  }
  const double gland = gland_brightness(work, found.ratio);
  double square = 0;
  for (const float share : in_fat) {
    const double off = fat_volume(share / of_fat, gland) - 1;
    square += off * off;
  }
  found.scatter = std::sqrt(square / double(in_fat.size()));
  found.muscle = fat_volume(of_muscle / of_fat, gland);
  for (float& share : found.ratio.voxels) share = float(fat_volume(share / of_fat, gland));
  return found;
}

}  // namespace breast
