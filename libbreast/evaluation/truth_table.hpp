// SPDX-License-Identifier: GPL-3.0-or-later
// Landmark positions from a fine solution, with their distance from a coarser solution of the same
// body as error.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// The landmark table `imaged` (phantom --truth) for the side of the meshes, extended by positions
/// from the meshes. There are meshes of two resolutions, each in the same postures (posture_of) and
/// with the landmarks of the table; the finer ones are the truth. For every posture,
/// POSTURE_{x,y,z}_mm comes from the finer mesh, except for prone, which remains as imaged.
/// POSTURE_own_error_mm is the distance of the landmark between the two meshes (for prone, the
/// larger of that and the distance to the imaged position). Throws Error (input) if postures,
/// landmarks, sides or plate gaps of the two resolutions differ.
Table truth_table(const Table& imaged, const std::vector<HexMesh>& meshes);

}  // namespace breast
