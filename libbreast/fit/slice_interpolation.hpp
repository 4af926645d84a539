// SPDX-License-Identifier: GPL-3.0-or-later
// Shape-based interpolation of a mask between thick slices (Raya and Udupa 1990).
#pragma once

#include "image/volume.hpp"

namespace breast {

/// Inserts slices along the axis of widest spacing until its spacing is about that of the others:
/// the signed distance to the mask's outline (mm) in every slice is interpolated linearly between
/// slices and converted back to occupancy with partial volumes. Without this, the skin of a scan
/// with 4 mm slices has steps. Masks with nearly equal spacings are returned unchanged.
Volume<float> fill_between_slices(const Volume<float>& mask);

}  // namespace breast
