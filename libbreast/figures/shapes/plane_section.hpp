// SPDX-License-Identifier: GPL-3.0-or-later
// Flat outlines of surfaces: where a plane cuts them, and their silhouette along a direction.
#pragma once

#include <array>
#include <vector>

#include "figures/canvas.hpp"

namespace breast {

/// Where the plane of points x with x . normal = offset cuts the facets.
std::vector<std::array<Vec3, 2>> plane_section(const Facets& facets, const Vec3& normal,
                                               double offset);
/// Outline of all that the facets cover when seen along `direction` with `up` on top; its points lie
/// in the plane through `depth`. Found on a raster of 0.5 mm, so correct to about that.
std::vector<std::array<Vec3, 2>> silhouette(const Facets& facets, const Vec3& direction,
                                            const Vec3& up, const Vec3& depth);

}  // namespace breast
