// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a surface file to an observed skin surface.
#pragma once

#include "identification/observations.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Points with normals from a triangle surface, or a point set that has normals; of a file of segment --points its
/// skin. At most 20000 points
/// are kept, evenly. Throws Error (input) beginning with `where` when there are no normals or fewer
/// than 50 points.
SeenSurface seen_surface(const TriMesh& surface, double deviation, const std::string& where);

}  // namespace breast
