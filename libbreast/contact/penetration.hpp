// SPDX-License-Identifier: GPL-3.0-or-later
// Depth to which the body penetrates a plate between its nodes, where contact is not imposed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/constraints.hpp"

namespace breast {

/// Boundary faces (skin, cut, chest wall) with a node that can move.
std::vector<Face> free_boundary_faces(const HexMesh& mesh, const Constraints& held);

/// Boundary faces that plates may touch: skin and cut.
std::vector<Face> touchable_faces(const HexMesh& mesh);

/// Deepest penetration of the faces into the plate in the shape `x` (3 per node), mm, at 5×5 points
/// of every face including its corners; 0 if there is none.
double deepest_penetration(const HexMesh& mesh, const std::vector<Face>& faces,
                           const Eigen::VectorXd& x, const Plate& plate);

}  // namespace breast
