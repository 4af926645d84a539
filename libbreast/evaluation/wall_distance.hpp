// SPDX-License-Identifier: GPL-3.0-or-later
// Distance between the chest walls of two label volumes.
#pragma once

#include "core/distances.hpp"
#include "image/label_volume.hpp"

namespace breast {

struct WallDistance {
  Distances distance;          ///< |dy|, mm, over the columns compared
  double bias_mm = 0;          ///< mean of given - true: positive when the given wall is deeper
  double columns = 0;          ///< number of compared columns
  double missing_percent = 0;  ///< of the true breast's columns without a wall in the given volume
  Distances on_breast;         ///< |dy|, mm, where the given wall is directly behind breast
  double columns_on_breast = 0;
};

/// Compares columns along patient y, 2 mm apart in x and z, wherever the true breast has muscle
/// directly behind it: the depth at which the true breast ends, and the depth at which the given
/// volume first is muscle (nearest voxels, sampled every 0.2 mm). Without such columns all values
/// are zero.
WallDistance compare_walls(const LabelVolume& given, const LabelVolume& truth);

}  // namespace breast
