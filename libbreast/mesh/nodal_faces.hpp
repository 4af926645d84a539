// SPDX-License-Identifier: GPL-3.0-or-later
// Areas and normals of boundary faces distributed to their nodes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mesh/topology.hpp"

namespace breast {

/// For every node of the mesh, in mm²: the area ∫ N_a dA over the faces, and the area vector ∫ N_a
/// n dA.
struct NodalFaces {
  std::vector<double> area;
  std::vector<Vec3> vector;
};
/// A factor for a place of a face, in the shape in which the areas are taken, and the outward unit normal there.
using FaceWeight = std::function<double(const Vec3& at, const Vec3& normal)>;

/// Nodal areas in the shape `x` (3 per node). `weight` multiplies the areas, but not the area vectors.
NodalFaces nodal_faces(const HexTopology& mesh, const std::vector<Face>& faces,
                       const Eigen::VectorXd& x, const FaceWeight& weight = {});

}  // namespace breast
