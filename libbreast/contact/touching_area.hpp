// SPDX-License-Identifier: GPL-3.0-or-later
// The area over which a body touches a plate, found on its faces instead of counted by nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// A point of a face nearer to a plate than this touches it, mm. In a converged state with contact of
/// faces the area within 0.3 mm is 3 to 6 % larger.
inline constexpr double touching_mm = 0.1;

/// Area (mm²) of those faces, in the shape `x` (3 per node), that touch the plate or are inside it. The
/// area of all nodes under pressure would include half of every face at the rim: on a mesh of 1068
/// elements it is 80 % larger.
double touching_area(const HexMesh& mesh, const std::vector<Face>& faces, const Eigen::VectorXd& x,
                     const Plate& plate);

}  // namespace breast
