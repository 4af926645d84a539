// SPDX-License-Identifier: GPL-3.0-or-later
// The arrays of a mesh with a value for every node or element. A table (mesh_columns.cpp) names each
// once: its path, whether it may be absent, and what its values may be. Writing, reading and checking
// follow it.
#pragma once

#include "io/hdf5/fields.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Throws Error by `complain` for an array of another length than the mesh's nodes or elements, or with
/// a value out of its bounds.
void check_columns(const HexMesh& mesh, const Complaint& complain);
/// Writes those that are there.
void put_columns(Document& document, const HexMesh& mesh);
/// Reads them into a mesh that has its points and elements; presence, shape and type are checked here,
/// values by check_columns.
void get_columns(Fields& fields, HexMesh& mesh);

}  // namespace breast
