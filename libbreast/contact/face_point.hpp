// SPDX-License-Identifier: GPL-3.0-or-later
// A point of a boundary face in a deformed shape.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "mesh/shape.hpp"

namespace breast {

struct FacePoint {
  Vec3 at{0, 0, 0};    ///< mm
  Vec3 area{0, 0, 0};  ///< ∂x/∂ξ × ∂x/∂η, outwards, mm² per unit of local coordinates
};

/// The point of the face with these nodes at which the shape functions are `shape`; `x`: one
/// position per node, mm.
FacePoint face_point(const std::vector<int>& nodes, const std::vector<Vec3>& x,
                     const QuadShape& shape);

}  // namespace breast
