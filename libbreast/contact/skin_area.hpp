// SPDX-License-Identifier: GPL-3.0-or-later
// Skin area per node and thickness of the breast along the beam, for contact.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Area (mm²) of the skin in shape `x` (3 per node) that belongs to each node: ∫ N_a dA.
std::vector<double> skin_area_per_node(const HexMesh& mesh, const Eigen::VectorXd& x);

/// Extent of the skin along n in the plane at the anterior coordinate a (mm); 0 if the plane meets
/// no skin.
double thickness_at(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate, double a);

}  // namespace breast
