// SPDX-License-Identifier: GPL-3.0-or-later
// The borders of the breast at which parts of its rim lie.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "surface/hermite.hpp"

namespace breast {

/// The breast ends at the sternum (medial), below the clavicle (superior), at the anterior axillary line
/// (lateral) and at the inframammary fold (inferior); the tissue beyond them is held differently.
enum class RimBorder : std::uint8_t { medial = 0, superior = 1, lateral = 2, inferior = 3 };
inline constexpr int n_rim_borders = 4;

std::string_view border_name(RimBorder border);

/// The border of every point (LPS, mm) of a closed rim: the quarter of the rim's box in the coronal
/// plane in which it lies, seen from the middle of the box, where the diagonals divide the quarters.
std::vector<RimBorder> rim_borders(const std::vector<Vec3>& rim, Side side);
/// The same for the rim of a geometry on its skin.
std::vector<RimBorder> rim_borders(const BreastGeometry& geometry);

}  // namespace breast
