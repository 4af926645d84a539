// SPDX-License-Identifier: GPL-3.0-or-later
// Planar outlines of surfaces: sections by a plane, and silhouettes along a direction.
#pragma once

#include <array>
#include <vector>

#include "figures/canvas.hpp"

namespace breast {

/// The section of the facets by the plane of points x with x . normal = offset.
std::vector<std::array<Vec3, 2>> plane_section(const Facets& facets, const Vec3& normal,
                                               double offset);
/// Outline of the facets seen along `direction` with `up` on top; its points lie in the plane
/// through `depth`. It is found on a raster of 0.5 mm and accurate to about that.
std::vector<std::array<Vec3, 2>> silhouette(const Facets& facets, const Vec3& direction,
                                            const Vec3& up, const Vec3& depth);

}  // namespace breast
