// SPDX-License-Identifier: GPL-3.0-or-later
// Adjustment of the rim so that the body has the volume of the segmented breast.
#pragma once

#include "fit/rim.hpp"

namespace breast {

/// Moves the rim in or out, by at most 20 mm along the skin, until skin, cut and wall enclose
/// `wanted_ml`: the rays locate the border of the breast only to a few mm, and the labels give its
/// volume. If the margin of the sheet or the construction of the cut prevents this, the closest
/// possible rim is used. Sets the geometry's centre and rim (its sheets must be there). Throws
/// Error (input) if no rim can be constructed at all.
Rim rim_of_volume(double wanted_ml, const WallSheet& wall, const RimRays& rays,
                  const RimOptions& options, BreastGeometry& geometry);

}  // namespace breast
