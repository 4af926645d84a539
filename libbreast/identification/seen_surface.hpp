// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a surface file to an observed skin surface.
#pragma once

#include "identification/observations.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Points with normals from a triangle surface or from a point set that has normals; from a file of
/// segment --points only the skin is taken. At most 20000 points are kept, evenly distributed.
/// Throws Error (input) with a message that begins with `where` if there are no normals or fewer
/// than 50 points.
SeenSurface seen_surface(const TriMesh& surface, double deviation, const std::string& where);

}  // namespace breast
