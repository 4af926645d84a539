// SPDX-License-Identifier: GPL-3.0-or-later
// What a hexahedral mesh of a breast is in every shape: its elements, what they consist of, and the
// sets of its faces, nodes and points.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// A face of the boundary: its element, and its local face in the VTK order of the hexahedron: 0
/// −ξ, 1 +ξ, 2 −η, 3 +η, 4 −ζ, 5 +ζ.
struct Face {
  int element = 0;
  int local = 0;
};

/// Local corner nodes of each face, ordered so that the right-hand normal points out of the element
/// (VTK node order of the 8-node hexahedron).
inline constexpr std::array<std::array<int, 4>, 6> hex_face_corners = {
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// A material point: the same imaged point for every mesh of one geometry.
struct Landmark {
  std::string name;      ///< "tumour", "nipple", ...
  Vec3 imaged{0, 0, 0};  ///< mm, LPS, the requested point
  int element = -1;      ///< containing element of the imaged mesh
  Vec3 local{0, 0, 0};   ///< (ξ,η,ζ) in [-1,1]^3
  double moved = 0;      ///< mm moved to reach the mesh (0 when inside)
};

enum class SkinModel : std::uint8_t { none = 0, membrane = 1, layer = 2 };

/// Hexahedra of order 1 (8 nodes, VTK_HEXAHEDRON) or 2 (27 nodes, VTK_TRIQUADRATIC_HEXAHEDRON), node
/// order as VTK. Arrays per element are either empty (absent) or of full length.
struct HexTopology {
  int order = 1;
  Side side = Side::left;
  std::vector<int> connectivity;
  /// Numbers of the elements and nodes in the whole mesh, ascending, if this is a part of one; empty
  /// otherwise.
  std::vector<int> element_numbers, node_numbers;

  std::vector<Tissue> tissue;                  ///< per element
  std::vector<float> fibroglandular_fraction;  ///< per element, may be empty

  std::vector<Face> skin_faces, pectoral_faces, cut_faces;  ///< disjoint, cover the boundary
  SkinModel skin_model = SkinModel::none;
  std::vector<double> skin_thickness;      ///< mm per skin face; membrane only
  int tumour_node = -1, nipple_node = -1;  ///< nearest nodes (paper mode)
  std::vector<Landmark> landmarks;

  int nodes_per_element() const { return order == 1 ? 8 : 27; }
  int elements() const { return int(connectivity.size()) / nodes_per_element(); }
  const int* element(int e) const {
    return connectivity.data() + std::size_t(e) * nodes_per_element();
  }
  const Landmark* landmark(std::string_view name) const;
};

/// Outward-ordered nodes of a boundary face: 4 corners (order 1) or 9 nodes (order 2: corners, edges,
/// centre, as VTK_BIQUADRATIC_QUAD).
std::vector<int> face_nodes(const HexTopology& mesh, const Face& face);
/// Sorted unique nodes of a face set.
std::vector<int> nodes_of(const HexTopology& mesh, const std::vector<Face>& faces);
/// All boundary faces (faces used by exactly one element).
std::vector<Face> boundary_faces(const HexTopology& mesh);
/// Position of local coordinates in the given nodal field (isoparametric).
Vec3 element_position(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element,
                      const Vec3& local);
/// Position of a landmark in the given nodal field (MeshShape::points, imaged or reference).
Vec3 landmark_position(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                       const Landmark& landmark);

}  // namespace breast
