// SPDX-License-Identifier: GPL-3.0-or-later
// Skin area per node and thickness of the breast along the beam, for contact.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Area (mm²) in shape `x` (3 per node) that belongs to each node, ∫ N_a dA: of the skin, or of all
/// faces that may touch a plate where contact is that of `faces`.
std::vector<double> contact_area_per_node(const HexMesh& mesh, const Eigen::VectorXd& x, bool faces);

/// Extent of the skin along n in the plane at the anterior coordinate a (mm); 0 if the plane meets
/// no skin.
double thickness_at(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate, double a);

}  // namespace breast
