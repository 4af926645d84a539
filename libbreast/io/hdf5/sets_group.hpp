// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of /breast/sets, /breast/landmarks and /breast/skin of a mesh file.
#pragma once

#include "io/hdf5/fields.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

void put_sets(Document& document, const HexMesh& mesh);
void get_sets(Fields& fields, HexMesh& mesh);
/// Checks that the node sets are the nodes of the face sets; the faces of the mesh must have passed
/// check_mesh.
void check_node_sets(Fields& fields, const HexMesh& mesh);

void put_landmarks(Document& document, const HexMesh& mesh);
void get_landmarks(Fields& fields, HexMesh& mesh);

void put_skin(Document& document, const HexMesh& mesh);
void get_skin(Fields& fields, HexMesh& mesh);

}  // namespace breast
