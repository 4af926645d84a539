// SPDX-License-Identifier: GPL-3.0-or-later
// The outer surface of the breast in a label volume.
#pragma once

#include "image/label_volume.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Voxel faces between the breast's tissues and anything else, two triangles each, in mm LPS. The
/// surface has the steps of the voxels: distances between such surfaces are accurate to about half
/// a voxel.
TriMesh breast_surface(const LabelVolume& labels);

}  // namespace breast
