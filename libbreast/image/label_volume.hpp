// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `segment`: tissue per voxel, fibroglandular fraction, chest-wall confidence, and
// where the breast and its nipple are.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"
#include "image/volume.hpp"

namespace breast {

/// Labels on one grid (the whole scan or a crop of it; only the chosen side's breast is `fat`,
/// `fibroglandular`, `skin`, `tumour`; everything behind the chest wall is `muscle`; body beyond the
/// breast's extent is `other`).
struct LabelVolume {
  Grid grid;
  std::vector<std::uint8_t> tissue;            ///< Tissue codes
  std::vector<float> fibroglandular_fraction;  ///< [0,1], 0 outside the breast
  std::vector<float> chest_wall_confidence;    ///< [0,1], constant along each chest-wall column
  Side side = Side::left;
  std::map<std::string, Vec3> landmarks;  ///< "nipple" (LPS mm), optionally "tumour"
  double skin_thickness = 0;              ///< mm, 0 when not measured
  std::optional<double> midline_mm;       ///< x of the body's midline; absent if not known
  /// Content of the scan as a segmentation of 3D Slicer states it, which has no history; otherwise empty.
  std::string scan_sha256;
  History history;
  std::string content_sha256;  ///< filled by the reader

  Tissue at(int i, int j, int k) const { return static_cast<Tissue>(tissue[grid.offset(i, j, k)]); }
};

}  // namespace breast
