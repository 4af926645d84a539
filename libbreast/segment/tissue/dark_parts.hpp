// SPDX-License-Identifier: GPL-3.0-or-later
// What is darker than any tissue of the breast.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Parts of at least 0.3 ml, of voxels that are darker than a tenth of fat.
struct DarkParts {
  Mask open;      ///< they touch what is not in the mask: air
  Mask enclosed;  ///< a clip, a vessel, a cyst
};

/// `brightness` is relative to fat. Skin, fat, fibroglandular tissue and muscle all have more than a
/// tenth of the brightness of fat in T1, haze of free air and signal voids have less.
DarkParts dark_parts(const Volume<float>& brightness, const Mask& mask);

}  // namespace breast
