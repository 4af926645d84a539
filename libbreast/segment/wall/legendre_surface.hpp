// SPDX-License-Identifier: GPL-3.0-or-later
// Robust fit of a smooth surface to a height field.
#pragma once

#include "segment/wall/chest_wall.hpp"

namespace breast {

/// Robust (iteratively reweighted, Tukey) fit of products of Legendre polynomials, degree <= 6
/// across one side and <= 3 along the body, weighted by confidence.
HeightField legendre_surface(const HeightField& depth, const HeightField& confidence,
                             const WallDomain& domain);

}  // namespace breast
