// SPDX-License-Identifier: GPL-3.0-or-later
// Distances between two surfaces in both directions.
#pragma once

#include "core/distances.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

struct SurfaceComparison {
  Distances to_truth;    ///< from the given surface's samples to the truth
  Distances from_truth;  ///< from the truth's samples to the given surface
  Distances both;        ///< all samples together; max is the Hausdorff distance
};

/// Distances between two surfaces. The samples are the centres of triangles, weighted by area, or
/// the points of a point set (no triangles), each with its distance to the nearest triangle (or
/// point) of the other surface. Throws Error (input) if either is empty.
SurfaceComparison compare_surfaces(const TriMesh& given, const TriMesh& truth);

}  // namespace breast
