// SPDX-License-Identifier: GPL-3.0-or-later
// The pose of the plates between which a mesh was compressed.
#pragma once

#include "mesh/hex_mesh.hpp"
#include "mesh/view_pose.hpp"

namespace breast {

/// Pose of the plates in the record of a compression; the mesh must have one.
ViewPose compressed_pose(const HexMesh& mesh);

}  // namespace breast
