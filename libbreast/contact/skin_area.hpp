// SPDX-License-Identifier: GPL-3.0-or-later
// Skin area per node and thickness of the breast along the beam, for contact.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// The faces that count as contact area: the skin, or in surface contact all faces that may touch a
/// plate.
std::vector<Face> contact_faces(const HexMesh& mesh, bool surface_contact);

/// Extent of the skin along n in the plane at the anterior coordinate a (mm); 0 if the plane meets
/// no skin.
double thickness_at(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate, double a);

}  // namespace breast
