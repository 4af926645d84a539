// SPDX-License-Identifier: GPL-3.0-or-later
// Shape-based interpolation of a mask between thick slices (Raya and Udupa 1990).
#pragma once

#include "image/volume.hpp"

namespace breast {

/// Inserts slices along the axis of widest spacing until it is about that of the others: in every
/// slice the signed distance to the mask's outline (mm), linear between slices, and back to
/// occupancy with partial volumes. Without it the skin of a scan with 4 mm slices is a staircase.
/// Masks with nearly equal spacings come back as they are.
Volume<float> fill_between_slices(const Volume<float>& mask);

}  // namespace breast
