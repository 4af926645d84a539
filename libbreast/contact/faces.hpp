// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a body at the plates, in a deformed shape: which may touch, over what area they do, and
// how deep they lie in a plate between their nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/shape.hpp"
#include "solve/constraints.hpp"

namespace breast {

/// Boundary faces (skin, cut, chest wall) with a node that can move.
std::vector<Face> free_boundary_faces(const HexTopology& mesh, const Constraints& held);

/// Boundary faces that plates may touch: skin and cut.
std::vector<Face> touchable_faces(const HexTopology& mesh);

/// A point of a boundary face in a deformed shape.
struct FacePoint {
  Vec3 at{0, 0, 0};    ///< mm
  Vec3 area{0, 0, 0};  ///< ∂x/∂ξ × ∂x/∂η, outwards, mm² per unit of local coordinates
};

/// The point of the face with these nodes at which the shape functions are `shape`; `x`: one
/// position per node, mm.
FacePoint face_point(const std::vector<int>& nodes, const std::vector<Vec3>& x,
                     const QuadShape& shape);

/// A point of a face nearer to a plate than this touches it, mm. In a converged state with contact of
/// faces the area within 0.3 mm is 3 to 6 % larger.
inline constexpr double touching_mm = 0.1;

/// Area (mm²) of those faces, in the shape `x` (3 per node), that touch the plate or are inside it. The
/// area of all nodes under pressure would include half of every face at the rim: on a mesh of 1068
/// elements it is 80 % larger.
double touching_area(const HexTopology& mesh, const std::vector<Face>& faces,
                     const Eigen::VectorXd& x, const Plate& plate);

/// Deepest penetration of the faces into the plate in the shape `x` (3 per node), mm, at 5×5 points
/// of every face including its corners; 0 if there is none.
double deepest_penetration(const HexTopology& mesh, const std::vector<Face>& faces,
                           const Eigen::VectorXd& x, const Plate& plate);

/// Extent of the skin along n in the plane at the anterior coordinate a (mm); 0 if the plane meets
/// no skin.
double thickness_at(const HexTopology& mesh, const Eigen::VectorXd& x, const Plate& plate,
                    double a);

}  // namespace breast
