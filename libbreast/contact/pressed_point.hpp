// SPDX-License-Identifier: GPL-3.0-or-later
// A point on which a plate presses: a node, or a quadrature point of a face.
#pragma once

#include "core/types.hpp"

namespace breast {

struct PressedPoint {
  int plate = 0;        ///< 0 paddle, 1 detector
  Vec3 at{0, 0, 0};     ///< mm
  Vec3 force{0, 0, 0};  ///< on the body, µN
};

}  // namespace breast
