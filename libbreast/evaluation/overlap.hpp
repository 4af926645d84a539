// SPDX-License-Identifier: GPL-3.0-or-later
// Voxelwise agreement of two label volumes.
#pragma once

#include <array>
#include <vector>

#include "image/label_volume.hpp"

namespace breast {

/// Volumes in ml and Dice = 2|A∩B| / (|A|+|B|) of one class; 1 when both are empty.
struct Overlap {
  double given_ml = 0, truth_ml = 0, dice = 0;
};

struct LabelOverlap {
  std::array<Overlap, n_tissues> tissue;  ///< by tissue code
  Overlap breast;                         ///< fat, fibroglandular, skin and tumour together
  Overlap body;                           ///< everything but air, where both volumes have voxels
};

/// Compares two label volumes, which may have different grids: each voxel of the finer grid is
/// compared with the nearest voxel of the other. The volumes are those of each volume's own grid,
/// so that truth beyond the edge of the given volume counts against it.
LabelOverlap compare_labels(const LabelVolume& given, const LabelVolume& truth);

/// Dice coefficient of fibroglandular tissue over the voxels that are breast in `given`, each of
/// which is compared with the nearest voxel of the truth; for truth in which the breast has no
/// border. Voxels of the truth with `half` (one entry a voxel, or empty) are half fibroglandular:
/// each counts as half a voxel of it. The truth's tumour is not counted. 1 without such tissue.
double gland_dice_in_breast(const LabelVolume& given, const LabelVolume& truth,
                            const std::vector<bool>& half = {});

}  // namespace breast
