// SPDX-License-Identifier: GPL-3.0-or-later
// One-to-one map of a disc-shaped triangle surface onto the unit square.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"
#include "fit/disc_surface.hpp"

namespace breast {

struct DiscMap {
  std::vector<Vec2> st;       ///< per point, in [0,1]^2
  int flipped = 0;            ///< triangles turned over in the square (0 expected)
  double area_ratio_p95 = 0;  ///< 95 % of |log| area distortion, as a ratio
  int solves = 0;
};

/// Tutte embedding with mean-value weights (Floater 2003). The border is mapped by arc length
/// between the points nearest to the corners of the (x,z) box. Reweighting w_ij /= sigma_j
/// (Yoshizawa 2004) then reduces the stretch as long as it falls. s increases towards +x, t towards
/// +z. Throws Error (input) if the border cannot be mapped to the square.
DiscMap map_to_square(const DiscSurface& surface, int max_solves = 4);

}  // namespace breast
