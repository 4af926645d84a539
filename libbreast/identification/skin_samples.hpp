// SPDX-License-Identifier: GPL-3.0-or-later
// Sample points on the skin at which a prediction is compared with an observed surface.
#pragma once

#include "identification/observations.hpp"

namespace breast {

/// Centres of skin faces at least `spacing` mm apart in the scan and away from the rim of the skin,
/// where the observed surface continues but the body does not.
std::vector<Location> skin_samples(const HexMesh& mesh, double spacing);

/// The distance (mm) of x from the surface along its normal, and that normal; no value if the
/// nearest observed point is more than `reach` away along the surface.
struct SurfaceDistance {
  double value = 0;
  Vec3 normal{0, 0, 1};
};
std::optional<SurfaceDistance> distance_to(const SeenSurface& surface, const Vec3& x);

}  // namespace breast
