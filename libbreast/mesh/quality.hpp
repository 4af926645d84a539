// SPDX-License-Identifier: GPL-3.0-or-later
// Shape quality of hexahedra: scaled Jacobians, determinants and volumes.
#pragma once

#include <array>
#include <vector>

#include "mesh/topology.hpp"

namespace breast {

/// Scaled Jacobian of a hexahedron from its 8 corners (VTK order), in [-1,1]; 1 is a brick. It is
/// the minimum over the corners and the centre of det(edges)/(product of their lengths), as defined
/// by Verdict and VTK (Stimpson et al., The Verdict Library Reference Manual, SAND2007, "hex scaled
/// Jacobian").
double scaled_jacobian(const Vec3* corners);

/// Scaled Jacobian of one element and of all elements in the given nodal field. For order 2 it is
/// the minimum at the 27 lattice points, with the tangents of the map as edges (the same number at
/// the corners of a straight element).
double scaled_jacobian(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element);
std::vector<double> scaled_jacobians(const HexTopology& mesh, const std::vector<Vec3>& nodal);

/// Volume of every element, mm³ (exact for order 1; 3³ Gauss points for order 2).
std::vector<double> element_volumes(const HexTopology& mesh, const std::vector<Vec3>& nodal);
double mesh_volume(const HexTopology& mesh, const std::vector<Vec3>& nodal);

struct MeshQuality {
  double min_scaled_jacobian = 0, median_scaled_jacobian = 0;
  int worst_element = -1;  ///< element with the worst scaled Jacobian
  /// Smallest and largest det ∂x/∂ξ (mm³) over the 27 lattice points and the Gauss points (2³, or
  /// 3³ for order 2) of all elements. A brick of volume V has V/8.
  double min_det = 0, max_det = 0;
  int worst_det_element = -1;
  /// Smallest of the elements' proved lower bounds of det ∂x/∂ξ (mm³; positivity.hpp): above 0 no
  /// element is folded anywhere.
  double min_det_bound = 0;
  int below_02 = 0, below_01 = 0;   ///< elements by scaled Jacobian
  int folded = 0;                   ///< elements not proved unfolded
  std::array<int, 10> histogram{};  ///< elements by scaled Jacobian: below 0.1, 0.1-0.2, ... 0.9-1
};
/// Throws Error (input) for an empty mesh.
MeshQuality mesh_quality(const HexTopology& mesh, const std::vector<Vec3>& nodal);

}  // namespace breast
