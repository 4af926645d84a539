// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as an input file of CalculiX or Abaqus (.inp).
#pragma once

#include <string>

#include "export/deck/scene.hpp"

namespace breast {

/// `element` is a type of that program: C3D8, C3D8I, C3D8R (8 nodes), C3D20, C3D20R (20 nodes).
/// Laws (9), Yeoh, Mooney–Rivlin and neo-Hookean with U = (K/2)(J−1)², that is D1 = 2/K; the
/// exponential law (10) is not in these programs. One static step with large displacements,
/// increments as the program chooses them. Results: displacements in the .frd file, the total force
/// on the held nodes in the .dat file. Throws Error (input) for what the program does not have.
std::string calculix_deck(const DeckScene& scene, const std::string& element);

}  // namespace breast
