// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/partial_volume.hpp"

#include <algorithm>
#include <functional>

#include "core/units.hpp"
#include "evaluation/overlap.hpp"
#include "image/nearest_voxel.hpp"

namespace breast {

PartialVolume compare_fractions(const LabelVolume& given, const LabelVolume& truth,
                                const Volume<float>& fraction) {
  const Grid& grid = fraction.grid;
  const NearestVoxel in_given(given.grid), in_truth(truth.grid);
  const auto tissue_at = [](const LabelVolume& labels, std::ptrdiff_t voxel) {
    return voxel < 0 ? Tissue::air : static_cast<Tissue>(labels.tissue[std::size_t(voxel)]);
  };
  const double scale =
      *std::max_element(fraction.voxels.begin(), fraction.voxels.end()) > 1.0f ? 1.0 / 255 : 1.0;
  std::vector<double> shares;
  double total = 0, given_voxels = 0, common = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 p = grid.to_patient(Vec3(i, j, k));
        const double share = scale * fraction.at(i, j, k);
        if (share > 0 && is_breast(tissue_at(truth, in_truth.at(p)))) {
          shares.push_back(share);
          total += share;
          if (tissue_at(given, in_given.at(p)) == Tissue::fibroglandular) common += share;
        }
      }
    }
  }
  PartialVolume result;
  const double voxel_ml = grid.voxel_volume() / mm3_per_ml,
               given_voxel_ml = given.grid.voxel_volume() / mm3_per_ml;
  for (const std::uint8_t tissue : given.tissue)
    given_voxels += tissue == std::uint8_t(Tissue::fibroglandular);
  for (const float f : given.fibroglandular_fraction) result.given_ml += f * given_voxel_ml;
  given_voxels *= given_voxel_ml / voxel_ml;
  result.truth_ml = total * voxel_ml;
  if (!(total > 0)) return result;
  result.dice = 2 * common / (given_voxels + total);
  std::sort(shares.begin(), shares.end(), std::greater<>());
  double sum = 0;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    sum += shares[n];
    result.ceiling = std::max(result.ceiling, 2 * sum / (double(n + 1) + total));
  }
  return result;
}

}  // namespace breast
