// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh must satisfy to be read or written: index ranges, full-length arrays, face sets.
#pragma once

#include "io/hdf5/fields.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

void check_mesh(const HexMesh& mesh, const Complaint& complain);

}  // namespace breast
