// SPDX-License-Identifier: GPL-3.0-or-later
// The skin as a term: a membrane on the skin faces. Scenes without membrane skin have no such term.
#pragma once

#include <memory>

#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/discretisation.hpp"
#include "solve/term.hpp"

namespace breast {

/// `space` is that of the underlying solid. Throws Error (input) if the thicknesses do not match
/// the faces.
std::shared_ptr<const Term> make_membrane(const HexMesh& mesh, const MechanicsOptions& options,
                                          const Discretisation& space);

}  // namespace breast
