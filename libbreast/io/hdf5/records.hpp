// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of /breast/model, /breast/solve and /breast/contact, the records of how a mesh
// file's shape was found.
#pragma once

#include "io/hdf5/fields.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

void put_model(Document& document, const ModelText& model);
ModelText get_model(Fields& fields);
void put_solve(Document& document, const SolveRecord& solve);
SolveRecord get_solve(Fields& fields);
void put_contact(Document& document, const ContactRecord& contact);
ContactRecord get_contact(Fields& fields);

}  // namespace breast
