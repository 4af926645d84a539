// SPDX-License-Identifier: GPL-3.0-or-later
// The skin as contact sees it: area per node, extent along the beam, contact per plate.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Area (mm²) of the skin in shape `x` (3 per node) that belongs to each node: ∫ N_a dA.
std::vector<double> skin_area_per_node(const HexMesh& mesh, const Eigen::VectorXd& x);

/// Extent of the skin along n on the plane at anterior coordinate a (mm); 0 where there is none.
double thickness_at(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate, double a);

}  // namespace breast
