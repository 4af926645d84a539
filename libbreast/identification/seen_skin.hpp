// SPDX-License-Identifier: GPL-3.0-or-later
// The skin observed in the second posture: from a surface file, and compared with samples of the skin.
#pragma once

#include "identification/observations.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Points with normals from a triangle surface or from a point set that has normals; from a file of
/// segment --points only the skin is taken. At most 20000 points are kept, evenly distributed.
/// Throws Error (input) with a message that begins with `where` if there are no normals or fewer
/// than 50 points.
SeenSurface seen_surface(const TriMesh& surface, double deviation, const std::string& where);

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
