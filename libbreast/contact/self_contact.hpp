// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a shape touches itself or the thorax beside its base: the equations keep neither apart.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

struct SelfContact {
  /// Free boundary with other parts of the body less than half a millimetre in front of it, or across
  /// it, cm².
  double itself_cm2 = 0;
  /// The greatest depth of the free boundary in the chest wall's surface, mm; 0 where there is none.
  double into_thorax_mm = 0;
};

/// Of the shape `x` (one position a node, mm), at 2×2 points of every skin and cut face.
SelfContact self_contact(const HexMesh& mesh, const std::vector<Vec3>& x);

}  // namespace breast
