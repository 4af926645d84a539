// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/tissue.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/grid/otsu.hpp"

namespace breast {

namespace {

// Vessels, ligaments and noise make specks; gland comes in lobes.
constexpr double least_lobe = 60;          // mm3
constexpr double growing_smoothing = 1.0;  // mm: keeps noise from carrying the growth into gland

/// Otsu's threshold of the interior's ratios in [0.1, 1.3].
double threshold_of_ratios(const Volume<float>& ratio, const Mask& interior) {
  constexpr int classes = 120;
  constexpr double low = 0.1, width = 0.01;
  std::vector<double> count(classes);
  for (std::size_t n = 0; n < ratio.voxels.size(); ++n) {
    if (!interior.voxels[n]) continue;
    const int c = int((ratio.voxels[n] - low) / width);
    if (c >= 0 && c < classes) count[c] += 1;
  }
  return low + width * otsu_class(count, classes / 2);
}

/// One seed per block of about 20 mm: its interior voxel nearest to the brightness of fat.
std::vector<std::array<int, 3>> fat_seeds(const Volume<float>& ratio, const Mask& interior) {
  const Grid& grid = ratio.grid;
  std::array<int, 3> block{};
  for (int d = 0; d < 3; ++d) block[d] = std::max(3, int(20 / grid.spacing[d]));
  std::vector<std::array<int, 3>> seeds;
  for (int k0 = 0; k0 < grid.size[2]; k0 += block[2]) {
    for (int j0 = 0; j0 < grid.size[1]; j0 += block[1]) {
      for (int i0 = 0; i0 < grid.size[0]; i0 += block[0]) {
        double best = 0.05;
        std::array<int, 3> seed{-1, 0, 0};
        for (int k = k0; k < std::min(k0 + block[2], grid.size[2]); ++k) {
          for (int j = j0; j < std::min(j0 + block[1], grid.size[1]); ++j) {
            for (int i = i0; i < std::min(i0 + block[0], grid.size[0]); ++i) {
              const double off = std::abs(ratio.at(i, j, k) - 1);
              if (!interior.at(i, j, k) || !(off < best)) continue;
              best = off;
              seed = {i, j, k};
            }
          }
        }
        if (seed[0] >= 0) seeds.push_back(seed);
      }
    }
  }
  return seeds;
}

/// Fibroglandular voxels of the interior: neither reached by growing the fat nor brighter than it.
/// All zero without seeds.
Mask gland_by_growing(const Volume<float>& ratio, const Mask& body, const Mask& interior) {
  Volume<float> inside = ratio;
  for (std::size_t n = 0; n < inside.voxels.size(); ++n)
    if (!body.voxels[n]) inside.voxels[n] = 0;
  inside = gaussian(std::move(inside), growing_smoothing);
  for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
    if (!interior.voxels[n]) inside.voxels[n] = -10;
  }
  const auto seeds = fat_seeds(ratio, interior);
  Mask gland(ratio.grid);
  if (seeds.empty()) return gland;
  const Mask fat = confidence_connected(std::move(inside), seeds, 1.5, 1, 5);
  for (std::size_t n = 0; n < gland.voxels.size(); ++n) {
    gland.voxels[n] = interior.voxels[n] && !fat.voxels[n] && ratio.voxels[n] < 1;
  }
  return gland;
}

/// Takes from `dark` its components smaller than `least` (mm3), and those that lie mostly by an
/// unsure wall: strands of muscle.
void remove_parts(Mask& dark, double least, const Mask& by_muscle) {
  const Components parts = components(dark);
  const std::vector<std::size_t> count = sizes(parts);
  std::vector<std::size_t> beside(count.size(), 0);
  for (std::size_t n = 0; n < dark.voxels.size(); ++n)
    beside[parts.label[n]] += by_muscle.voxels[n];
  for (std::size_t n = 0; n < dark.voxels.size(); ++n) {
    const std::uint32_t part = parts.label[n];
    const bool small = double(count[part]) * dark.grid.voxel_volume() < least;
    if (small || 2 * beside[part] > count[part]) dark.voxels[n] = 0;
  }
}

/// Median of the voxels darker than `start` all of whose neighbours are so too: gland without fat in
/// it. Where there are few, the darker end of all dark ones, which fat brightens.
double brightness_of_gland(const Volume<float>& ratio, const Mask& interior, double start,
                           double fallback) {
  constexpr double enough = 300;  // mm3
  const Grid& grid = ratio.grid;
  const auto is_dark = [&](int i, int j, int k) {
    return grid.contains(i, j, k) && interior.at(i, j, k) && ratio.at(i, j, k) < start;
  };
  std::vector<float> dark, core;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_dark(i, j, k)) continue;
        dark.push_back(ratio.at(i, j, k));
        if (is_dark(i - 1, j, k) && is_dark(i + 1, j, k) && is_dark(i, j - 1, k) &&
            is_dark(i, j + 1, k) && is_dark(i, j, k - 1) && is_dark(i, j, k + 1))
          core.push_back(dark.back());
      }
    }
  }
  if (double(core.size()) * grid.voxel_volume() > enough)
    return percentile(std::move(core), 0.5, fallback);
  return percentile(std::move(dark), 0.15, fallback);
}

/// Voxels of `mask` and those within about 1.5 mm of it, in `interior`.
Mask with_surroundings(const Mask& mask, const Mask& interior) {
  Volume<float> found(mask.grid);
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) found.voxels[n] = mask.voxels[n];
  const double reach = std::max(1.5, 1.01 * mask.grid.spacing.minCoeff());
  const Volume<float> wider = box_maximum(std::move(found), reach);
  Mask out(mask.grid);
  for (std::size_t n = 0; n < mask.voxels.size(); ++n)
    out.voxels[n] = interior.voxels[n] && wider.voxels[n] > 0;
  return out;
}

/// Added to every share before it is clipped to [0,1] so that the clipped ones keep the sum.
double shift_keeping_sum(const std::vector<float>& shares) {
  double wanted = 0;
  for (const float share : shares) wanted += share;
  double low = -1, high = 1;
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (low + high);
    double sum = 0;
    for (const float share : shares) sum += std::clamp(share + middle, 0.0, 1.0);
    (sum < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Voxels darker than fat's scatter reaches and than a third of gland in fat would make them, in
/// parts too large for noise, and what surrounds them: there is gland nowhere else.
Mask where_gland_is(const Volume<float>& ratio, const Mask& interior, const Mask& by_muscle,
                    double gland_ratio, double fat_cv) {
  constexpr double least_part = 12;  // mm3
  const double limit = 1 - std::max(3.5 * fat_cv, (1 - gland_ratio) / 3);
  Mask dark(ratio.grid);
  for (std::size_t n = 0; n < ratio.voxels.size(); ++n)
    dark.voxels[n] = interior.voxels[n] && ratio.voxels[n] < limit;
  remove_parts(dark, std::max(least_part, 3 * ratio.grid.voxel_volume()), by_muscle);
  return with_surroundings(dark, interior);
}

/// Fills the fractions: there, a voxel's brightness says its mixture. Clipping alone would lose what
/// scatters beyond pure gland and add what scatters beyond pure fat.
void fill_fractions(Fibroglandular& result, const Volume<float>& ratio, const Mask& there,
                    double fat_cv) {
  const double contrast = 1 - result.gland_ratio;
  const double beyond = 3 * fat_cv / contrast;  // of gland or fat: other tissue, not scatter
  const auto share_of = [&](std::size_t n) {
    return float(std::clamp((1 - ratio.voxels[n]) / contrast, -beyond, 1 + beyond));
  };
  std::vector<float> shares;
  for (std::size_t n = 0; n < ratio.voxels.size(); ++n) {
    if (there.voxels[n]) shares.push_back(share_of(n));
  }
  const double shift = shift_keeping_sum(shares);
  for (std::size_t n = 0; n < ratio.voxels.size(); ++n) {
    if (there.voxels[n])
      result.fraction.voxels[n] = float(std::clamp(share_of(n) + shift, 0.0, 1.0));
  }
}

void compare(Fibroglandular& result, const Mask& interior, const Mask& dark,
             const Mask& by_growing) {
  double all = 0, grown = 0, by_threshold = 0, both = 0;
  for (std::size_t n = 0; n < interior.voxels.size(); ++n) {
    if (!interior.voxels[n]) continue;
    const bool a = dark.voxels[n] != 0, b = by_growing.voxels[n] != 0;
    all += 1;
    grown += b;
    by_threshold += a;
    both += a && b;
  }
  result.fat_fraction_grown = all > 0 ? 1 - grown / all : 0;
  result.agreement = grown + by_threshold > 0 ? 2 * both / (grown + by_threshold) : 1;
}

}  // namespace

Fibroglandular find_fibroglandular(const Volume<float>& ratio, const Mask& body,
                                   const Mask& interior, const Mask& by_muscle, double muscle_ratio,
                                   double fat_cv, Interior interior_by) {
  Fibroglandular result;
  // Midway between gland and fat (1 by the bias correction). Without gland Otsu would split the fat
  // in two: gland is darker than fat's scatter reaches, and the search starts and ends there.
  const double brightest_gland = std::clamp(1 - 3 * fat_cv, 0.8, 0.87);
  const double start = std::clamp(threshold_of_ratios(ratio, interior),
                                  0.5 * (1 + muscle_ratio) - 0.15, brightest_gland);
  result.gland_ratio = std::clamp(brightness_of_gland(ratio, interior, start, muscle_ratio),
                                  0.5 * muscle_ratio, brightest_gland - 0.05);
  result.threshold = std::min(0.5 * (1 + result.gland_ratio), brightest_gland);
  result.fraction = Volume<float>(ratio.grid);
  Mask lobes(ratio.grid);
  for (std::size_t n = 0; n < ratio.voxels.size(); ++n) {
    lobes.voxels[n] = interior.voxels[n] && ratio.voxels[n] < result.threshold;
  }
  fill_fractions(result, ratio,
                 where_gland_is(ratio, interior, by_muscle, result.gland_ratio, fat_cv), fat_cv);
  remove_parts(lobes, least_lobe, by_muscle);
  double gland = 0, all = 0;
  for (std::size_t n = 0; n < lobes.voxels.size(); ++n) {
    gland += lobes.voxels[n];
    all += interior.voxels[n];
  }
  result.fat_fraction = all > 0 ? 1 - gland / all : 0;
  const Mask grown = gland_by_growing(ratio, body, interior);
  compare(result, interior, lobes, grown);
  if (interior_by == Interior::region_growing) {
    if (fat_seeds(ratio, interior).empty()) {
      throw input_error(
          "no voxel of the breast is as bright as fat, so that region growing has no seed; use "
          "--interior threshold");
    }
    for (std::size_t n = 0; n < ratio.voxels.size(); ++n) {
      result.fraction.voxels[n] = grown.voxels[n] ? 1 : 0;
    }
    lobes = grown;
  }
  result.lobes = std::move(lobes);
  return result;
}

}  // namespace breast
