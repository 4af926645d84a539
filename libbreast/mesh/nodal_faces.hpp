// SPDX-License-Identifier: GPL-3.0-or-later
// Areas and normals of boundary faces distributed to their nodes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// For every node of the mesh, in mm²: the area ∫ N_a dA over the faces, and the area vector ∫ N_a
/// n dA.
struct NodalFaces {
  std::vector<double> area;
  std::vector<Vec3> vector;
};
/// Nodal areas in the shape `x` (3 per node). `weight` multiplies the areas, but not the area
/// vectors, by a function of the outward unit normal.
NodalFaces nodal_faces(const HexMesh& mesh, const std::vector<Face>& faces,
                       const Eigen::VectorXd& x,
                       const std::function<double(const Vec3& normal)>& weight = {});

}  // namespace breast
