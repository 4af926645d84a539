// SPDX-License-Identifier: GPL-3.0-or-later
// Measurement of the skin's thickness from the intensity profile between air and fat.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Skin thickness (mm); 0 where too little of the skin has fat behind it (fewer than 200 voxels).
/// Across the skin a blurred dark layer between air and fat is missing brightness in proportion to
/// its thickness, also where it is thinner than a voxel; darkness and thickness of so thin a layer
/// cannot be told apart, so skin is taken to be half as bright as fat (0.4 to 0.6 as bright moves a
/// layer of two voxels by a tenth). Profiles along the skin's normals, those
/// across thick slices left out, each from where it passes a quarter of fat; the median counts.
/// `brightness`: scan over bias (1 in fat), also outside the body; `skin_distance` (mm) of the
/// body, negative inside.
double skin_thickness(const Volume<float>& brightness, const Mask& breast,
                      const Volume<float>& skin_distance);

}  // namespace breast
