// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "segment/grid/filters.hpp"
#include "segment/work.hpp"

namespace breast {

namespace {

/// 0 where scans with bright fat end, 1 at a saturated one, at most `most`.
double grade(double value, double bright, double saturated, double most) {
  return std::clamp((value - bright) / (saturated - bright), 0.0, most);
}

float squared(float value) {
  return value * value;
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
  return contrast;
}

double saturation_evidence(const FatContrast& contrast) {
  // Muscle, noise and bright skin each have other causes and never refuse a scan alone; fat darker
  // than a third of what surrounds it has none. Behind a wall sought in saturated fat there may be
  // lung. A ratio of 0 has not been measured.
  const double muscle = contrast.muscle_ratio;
  const double dark_muscle = muscle > 0 ? grade(muscle, 0.15, 0.08, 1) : 0;
  return grade(contrast.skin_to_subcutis, 1.14, 1.7, 1) + grade(contrast.fat_cv, 0.086, 0.10, 1) +
         std::max(grade(muscle, 0.45, 0.59, 1), dark_muscle) +
         grade(contrast.subcutaneous, 0.5, 0.39, 2);
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
      format_fixed(100 * contrast.fat_cv, 1), " % (below 8.6): evidence ",
      format_fixed(evidence, 1), ", at most ", most_evidence,
      " accepted. Give the T1 series without fat saturation, or --contrast fat-bright if this "
      "is such a series");
}

}  // namespace breast
