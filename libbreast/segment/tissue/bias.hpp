// SPDX-License-Identifier: GPL-3.0-or-later
// Estimation of the coil sensitivity (bias field) from the brightness of fat.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

struct BiasField {
  Volume<float> log_bias;  ///< log of the local brightness of fat, on the grid given
  double range = 1;        ///< ratio of the 99th to the 1st percentile of the bias in fat
  double fat_cv_before = 0, fat_cv_after = 0;  ///< coefficient of variation of fat
};

struct BiasSettings {
  double window = 50;  ///< mm; fat is within exp(-seed_drop) of the brightest voxel in this window
  double core = 4;     ///< mm; distance from air that is not used (skin)
  double sigma = 8;    ///< mm; smoothing
  /// Estimate the scatter of fat from its bright side instead of assuming a generous 10 %. This
  /// excludes voxels shared with fibroglandular tissue, but is only valid once the rest of the
  /// field is correct.
  bool refined = false;
};

/// Tissue of one brightness that is no fat, with a closed edge: fat that is dimmer by a constant. Where it
/// fills much of a breast, fat alone says nothing about the bias in its midst.
struct DimTissue {
  Volume<float> share;  ///< of a voxel
  double step = 0;      ///< log of the brightness of fat over its own, first estimate
};

/// `allowed` marks tissue that may be fat (in front of the depth limit or of the chest wall);
/// `skin_distance` (mm) is the depth below the body's surface. `previous` (may be null) is an
/// earlier estimate, by which the scan is divided before fat is sought, so that the window can be
/// wide enough to include fat around compact fibroglandular tissue. `dim` (may be null) lies
/// outside `allowed`. All are on one grid.
BiasField fat_bias(const Volume<float>& scan, const Mask& allowed,
                   const Volume<float>& skin_distance, const BiasSettings& settings,
                   const Volume<float>* previous, const DimTissue* dim = nullptr);

}  // namespace breast
