// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's rib cage as the surface that mesh files hold, so that compress can slide on it.
#pragma once

#include "phantom/parameters.hpp"
#include "surface/thorax.hpp"

namespace breast {

/// RibSurface as a spline about an axis through the middle of the sections: all round but for 16 degrees
/// at the spine, 300 mm up and down. On the surface the two agree within 1e-4 mm for sections of power 2;
/// in front of it each has its own measure of depth. Throws Error (input) for a power below 2.
ThoraxSurface rib_spline(const TorsoParameters& torso);

}  // namespace breast
