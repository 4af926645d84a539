// SPDX-License-Identifier: GPL-3.0-or-later
// Estimation of the coil sensitivity (bias field) from the brightness of fat.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

struct BiasField {
  Volume<float> log_bias;  ///< log of the local brightness of fat, on the grid given
  double range = 1;        ///< 99 % over 1 % of the bias where there is fat
  double fat_cv_before = 0, fat_cv_after = 0;  ///< coefficient of variation of fat
};

struct BiasSettings {
  double window = 50;  ///< mm: fat is within exp(-seed_drop) of the brightest in this window
  double core = 4;     ///< mm from air that are not used (skin)
  double sigma = 8;    ///< mm of the smoothing
  /// Take fat's scatter from its bright side instead of a generous 10 %: keeps what shares a voxel
  /// with gland out, once the rest of the field is right (and so only then).
  bool refined = false;
};

/// `allowed` marks tissue that may be fat (in front of the depth limit or of the chest wall);
/// `skin_distance` (mm) is the depth below the body's surface. `previous` (may be null) is an
/// earlier estimate, divided out before fat is sought: the window may then stay wide enough to see
/// fat around a compact gland. All on one grid.
BiasField fat_bias(const Volume<float>& scan, const Mask& allowed,
                   const Volume<float>& skin_distance, const BiasSettings& settings,
                   const Volume<float>* previous);

}  // namespace breast
