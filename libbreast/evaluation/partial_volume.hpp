// SPDX-License-Identifier: GPL-3.0-or-later
// Agreement of fibroglandular fractions in voxels of mixed tissue, and the best that a labelling
// can reach.
#pragma once

#include "image/label_volume.hpp"

namespace breast {

struct PartialVolume {
  double dice = 0;      ///< Dice coefficient of the given fibroglandular voxels with the true
                        ///< fractions
  double ceiling = 0;   ///< the highest Dice that any labelling of these voxels could reach
  double truth_ml = 0;  ///< fibroglandular tissue by fraction
  double given_ml = 0;  ///< the given volume's own sum of fractions
};

/// Agreement with `fraction`, the true fraction of fibroglandular tissue per voxel (0 to 1 or 0 to
/// 255), counted where `truth` is breast. The overlap of a voxel with the tissue is its fraction,
/// so that Dice = 2 sum(f over given) / (voxels given + sum(f)). The ceiling is the Dice
/// coefficient of the voxels with the largest fractions.
PartialVolume compare_fractions(const LabelVolume& given, const LabelVolume& truth,
                                const Volume<float>& fraction);

}  // namespace breast
