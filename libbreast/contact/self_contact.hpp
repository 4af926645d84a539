// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of contact of a shape with itself or with the thorax beside its base, which the
// equations do not prevent.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

struct SelfContact {
  /// Area of the free boundary that has other parts of the body less than half a millimetre in
  /// front of it, or penetrating it, cm².
  double itself_cm2 = 0;
  /// Greatest depth to which the free boundary penetrates the chest-wall surface, mm; 0 without
  /// such a surface.
  double into_thorax_mm = 0;
};

/// Self-contact of the shape `x` (one position per node, mm), at 2×2 points of every skin and cut
/// face.
SelfContact self_contact(const HexMesh& mesh, const std::vector<Vec3>& x);

}  // namespace breast
