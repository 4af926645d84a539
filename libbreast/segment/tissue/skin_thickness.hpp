// SPDX-License-Identifier: GPL-3.0-or-later
// Measurement of the skin's thickness from the intensity profile between air and fat.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Skin thickness in mm; 0 if too little of the skin has fat behind it (fewer than 200 voxels).
///
/// A blurred dark layer between air and fat reduces the brightness in proportion to its thickness,
/// even if it is thinner than a voxel. The darkness and the thickness of such a thin layer cannot
/// be distinguished, so that skin is assumed to be half as bright as fat (0.4 or 0.6 instead
/// changes a layer of two voxels by a tenth). The thickness is the median over profiles along the
/// skin's normals, without those across thick slices; each profile begins where the brightness
/// reaches a quarter of that of fat. `brightness` is the scan divided by the bias (1 in fat), also
/// outside the body; `skin_distance` (mm) is the distance from the body, negative inside.
double skin_thickness(const Volume<float>& brightness, const Mask& breast,
                      const Volume<float>& skin_distance);

}  // namespace breast
