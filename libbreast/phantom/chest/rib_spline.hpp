// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's rib cage in the form that mesh files store, so that compress can use it as the
// sliding surface.
#pragma once

#include "phantom/parameters.hpp"
#include "surface/thorax.hpp"

namespace breast {

/// RibSurface as a spline about an axis through the centres of the sections, all around except for
/// 16 degrees at the spine, and 300 mm up and down. On the surface the two agree within 1e-4 mm for
/// sections of power 2; in front of it each has its own measure of depth. Throws Error (input) for
/// a power below 2.
ThoraxSurface rib_spline(const TorsoParameters& torso);

}  // namespace breast
