// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a mesh that is read or written: index ranges, array lengths, face sets.
#pragma once

#include "io/hdf5/fields.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

void check_mesh(const HexMesh& mesh, const Complaint& complain);

}  // namespace breast
