// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/work.hpp"

namespace breast {

namespace {

/// Linear from 0 at `none` to 1 at `full` and beyond, never below 0 or above `most`. A score is 0 where scans with bright fat end and
/// 1 in a saturated scan.
double grade(double value, double none, double full, double most) {
  return std::clamp((value - none) / (full - none), 0.0, most);
}

/// Largest score of a sternum that lies deep. It counts less if fat explains the depth: fat that is thick and bright over the
/// sternum is bright below the skin too. On sides with bright fat, the tissue below the skin has 0.82 to 0.91 of the greatest
/// brightness nearby. (One woman has 0.76 on both sides, but her sternum is not deep.) Where muscle is as bright as fat, it has at
/// most 0.76.
double deep_sternum(const FatContrast& contrast) {
  if (!contrast.skin_resolved) return 1.2;
  return 1 - 0.2 * grade(contrast.subcutaneous, 0.78, 0.82, 1);
}

float squared(float value) {
  return value * value;
}

/// Within `reach` mm of the air around the body, but not of what is as dark inside it and open to it
/// by narrow holes alone.
Mask near_free_air(const Volume<float>& skin_distance, double reach) {
  Mask wide(skin_distance.grid);
  for (std::size_t n = 0; n < wide.voxels.size(); ++n)
    wide.voxels[n] = skin_distance.voxels[n] > reach;
  const Volume<float> distance = signed_distance(largest_component(wide));
  for (std::size_t n = 0; n < wide.voxels.size(); ++n) wide.voxels[n] = distance.voxels[n] < reach;
  return wide;
}

/// The breast down to `behind_sternum` mm behind the sternal skin, with hollows in it that are as
/// dark as air: they have body on both sides, and in front of them.
Mask with_hollows(const Work& work, double behind_sternum) {
  constexpr double holes = 4;  // mm
  const Grid& grid = work.scan.grid;
  const Mask air = near_free_air(work.skin_distance, holes);
  Mask inside(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    const int last =
        std::min(grid.size[1], int((work.torso.cleft[k] + behind_sternum) / grid.spacing[1]));
    std::vector<std::uint8_t> in_front(std::size_t(grid.size[0]));
    for (int j = 0; j < last; ++j) {
      int first = grid.size[0], end = 0;
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!work.body.mask.at(i, j, k)) continue;
        in_front[std::size_t(i)] = 1;
        first = std::min(first, i);
        end = i + 1;
      }
      for (int i = first; i < end; ++i) {
        const bool hollow = in_front[std::size_t(i)] && !air.at(i, j, k);
        inside.at(i, j, k) = work.body.mask.at(i, j, k) || hollow;
      }
    }
  }
  return inside;
}

/// What a ball of this radius (mm) fits into: an implant, which is as silent as half of a Dixon scan.
Mask compact_part(const Mask& mask, double radius) {
  constexpr double border = 2;  // mm
  const Volume<float> depth = signed_distance(mask);
  Mask part(mask.grid);
  for (std::size_t n = 0; n < part.voxels.size(); ++n) part.voxels[n] = depth.voxels[n] < -radius;
  if (std::none_of(part.voxels.begin(), part.voxels.end(), [](auto v) { return v; })) return part;
  const Volume<float> distance = signed_distance(part);
  for (std::size_t n = 0; n < part.voxels.size(); ++n)
    part.voxels[n] = distance.voxels[n] < radius + border;
  return part;
}

/// As FatContrast::silent_share.
double silent_share(const Work& work) {
  constexpr double behind_sternum = 10, skin = 4, around = 25, compact = 15;  // mm
  constexpr float silent = 0.15f;
  const Mask inside = with_hollows(work, behind_sternum);
  const Volume<float> distance = signed_distance(inside);
  Volume<float> tissue(work.scan.grid);
  for (std::size_t n = 0; n < tissue.voxels.size(); ++n)
    if (inside.voxels[n]) tissue.voxels[n] = work.scan.voxels[n];
  const Volume<float> brightest = box_maximum(gaussian(tissue, 1.5), around);
  Mask dark(work.scan.grid);
  double all = 0;
  for (std::size_t n = 0; n < tissue.voxels.size(); ++n) {
    if (!(-distance.voxels[n] > skin)) continue;
    all += 1;
    dark.voxels[n] = work.scan.voxels[n] < silent * brightest.voxels[n];
  }
  const Mask implant = compact_part(dark, compact);
  double found = 0;
  for (std::size_t n = 0; n < dark.voxels.size(); ++n)
    found += dark.voxels[n] && !implant.voxels[n];
  return all > 0 ? found / all : 0;
}

}  // namespace

FatContrast contrast_below_skin(const Work& work, double behind_sternum) {
  const Grid& grid = work.scan.grid;
  Volume<float> tissue(grid), subcutis(grid), weight(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1] && j * grid.spacing[1] < work.torso.cleft[k] + behind_sternum;
         ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        const double depth = -work.skin_distance.voxels[n];
        if (depth > 3) tissue.voxels[n] = work.scan.voxels[n];
        if (!(depth > 4 && depth < 8)) continue;
        subcutis.voxels[n] = squared(squared(work.scan.voxels[n]));
        weight.voxels[n] = 1;
      }
    }
  }
  FatContrast contrast;
  const Volume<float> brightest = box_maximum(gaussian(tissue, 1.5), 25);
  std::vector<float> shares, skin;
  for (std::size_t n = 0; n < tissue.voxels.size(); ++n) {
    if (weight.voxels[n] > 0 && tissue.voxels[n] > 0)
      shares.push_back(tissue.voxels[n] / brightest.voxels[n]);
  }
  contrast.subcutaneous = percentile(std::move(shares), 0.5, 1);
  subcutis = gaussian(subcutis, 10);
  weight = gaussian(weight, 10);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1] && j * grid.spacing[1] < work.torso.cleft[k] + behind_sternum;
         ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        const double depth = -work.skin_distance.voxels[n];
        if (!(depth > 0 && depth < 2.5 && weight.voxels[n] > 0.02f)) continue;
        // The mean of fourth powers is that of the brighter part: where gland reaches the skin, fat.
        const float below = std::sqrt(std::sqrt(subcutis.voxels[n] / weight.voxels[n]));
        skin.push_back(work.scan.voxels[n] / std::max(below, 1e-6f));
      }
    }
  }
  contrast.skin_to_subcutis = percentile(std::move(skin), 0.9, 0);
  contrast.silent_share = silent_share(work);
  constexpr double too_wide = 2.2;  // mm, beside skin of 0.5 to 2
  contrast.skin_resolved = 0.5 * (grid.spacing[0] + grid.spacing[1]) < too_wide;
  return contrast;
}

void complete_contrast(FatContrast& contrast, const Work& work, Side side) {
  double seen = 0, count = 0;
  for (int k = 0; k < work.wall.depth.nz; ++k) {
    for (int i = work.domain.first; i <= work.domain.last; ++i) {
      if (std::isnan(work.wall.depth.at(i, k))) continue;
      seen += work.wall.confidence.at(i, k) > 0.5;
      count += 1;
    }
  }
  if (count > 0) contrast.wall_seen = seen / count;
  contrast.sternal_thickness =
      find_extent(work.wall, work.domain, work.torso, work.skin_distance, side).sternal_thickness;
}

double saturation_evidence(const FatContrast& contrast) {
  // Muscle, noise, bright skin, a deep sternum (breasts that touch in front of it) and a wall that is
  // hard to see each have other causes and never refuse a scan alone (a deep sternum does where the
  // skin cannot speak against it); fat darker than a third of what surrounds it has none. Behind a wall sought in saturated fat there may be
  // lung. A ratio of 0 has not been measured.
  const double muscle = contrast.muscle_ratio;
  const double dark_muscle = muscle > 0 ? grade(muscle, 0.15, 0.08, 1) : 0;
  return grade(contrast.skin_to_subcutis, 1.14, 1.7, 1) + grade(contrast.fat_cv, 0.086, 0.10, 1) +
         std::max(grade(muscle, 0.45, 0.59, 1), dark_muscle) +
         grade(contrast.subcutaneous, 0.5, 0.39, 2) +
         grade(contrast.sternal_thickness, 22, 28, deep_sternum(contrast)) +
         grade(contrast.wall_seen, 0.58, 0.34, 1);
}

std::string refusal_of(const FatContrast& contrast) {
  const double evidence = saturation_evidence(contrast);
  if (!(evidence > most_evidence)) return "";
  return message(
      "fat is saturated or, for another reason, not the bright tissue of this scan: below the "
      "skin it has ",
      std::lround(100 * contrast.subcutaneous),
      " % of the brightness around it (usually above 50), the skin ",
      std::lround(100 * contrast.skin_to_subcutis),
      " % of its own (below 114), what lies behind the chest wall ",
      std::lround(100 * contrast.muscle_ratio), " % (15 to 45), and it varies by ",
      format_fixed(100 * contrast.fat_cv, 1), " % (below 8.6); the wall is seen on ",
      std::lround(100 * contrast.wall_seen), " % of the columns (above 58), ",
      std::lround(contrast.sternal_thickness),
      " mm behind the sternum's skin (below 22): evidence ", format_fixed(evidence, 1),
      ", at most ", most_evidence, " accepted");
}

std::string refusal_of_half(const FatContrast& contrast) {
  constexpr double most_silent = 0.1, most_if_odd = 0.03, least_muscle = 0.12, odd_evidence = 0.8;
  constexpr double silent_muscle = 0.08, most_beside_it = 0.01;  // of a fatty breast in a fat image
  // In a fat image, muscle is silent too; a wall sought in a water image has other oddities.
  const bool odd = (contrast.muscle_ratio > 0 && contrast.muscle_ratio < least_muscle) ||
                   saturation_evidence(contrast) > odd_evidence;
  const bool silent = contrast.muscle_ratio > 0 && contrast.muscle_ratio < silent_muscle;
  const double most = silent ? most_beside_it : odd ? most_if_odd : most_silent;
  if (!(contrast.silent_share > most)) return "";
  return message("this looks like the water or the fat image of a Dixon scan alone: ",
                 std::lround(100 * contrast.silent_share),
                 " % of the breast has less than 15 % of the brightness around it (at most ",
                 std::lround(100 * most), " %), as only one of the two gives a signal");
}

}  // namespace breast
