// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary faces spread over their nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Per node of the mesh, mm²: ∫ N_a dA over the faces, and with its direction ∫ N_a n dA.
struct NodalFaces {
  std::vector<double> area;
  std::vector<Vec3> vector;
};
/// In the shape `x` (3 per node).
NodalFaces nodal_faces(const HexMesh& mesh, const std::vector<Face>& faces,
                       const Eigen::VectorXd& x);

}  // namespace breast
