// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as an input file of FEBio 4 (.feb).
#pragma once

#include <string>

#include "export/deck/scene.hpp"

namespace breast {

/// 8-node elements are FEBio's three-field hexahedra (its default for uncoupled materials), 20-node
/// ones its hex20. Mooney–Rivlin and neo-Hookean by name, every other law as the formula W(I1, I2)
/// of the isochoric invariants; U = (K/2)(ln J)². Gravity is a body force per unit mass. The log
/// file displacement.log holds node, ux, uy, uz. Throws Error (input) for rollers.
std::string febio_deck(const DeckScene& scene);

}  // namespace breast
