// SPDX-License-Identifier: GPL-3.0-or-later
// Distances between points and a triangle surface.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Distance (mm) of every query to the nearest point of the triangles, in the order of the queries;
/// deterministic.
std::vector<double> distances_to_triangles(const std::vector<Vec3>& points,
                                           const std::vector<std::array<int, 3>>& triangles,
                                           const std::vector<Vec3>& queries);

}  // namespace breast
