// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue around the breast that is meshed with it (elements of Tissue::other), to which the breast is
// attached instead of to supports at its lateral cut. It belongs neither to the breast's volume nor
// to its muscle; `restricted(mesh, breast_elements)` is the breast alone (mesh/part.hpp).
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

inline bool is_around_breast(const HexTopology& mesh, int element) {
  return mesh.tissue[std::size_t(element)] == Tissue::other;
}
/// The elements of the breast, ascending. Throws Error (input) if there is nothing but tissue around
/// one.
std::vector<int> breast_elements(const HexTopology& mesh);
/// Those of the faces that are faces of the breast.
std::vector<Face> of_breast(const HexTopology& mesh, const std::vector<Face>& faces);
/// Whether two meshes are of one breast: the same elements, but for the tissue around it.
bool have_same_breast(const HexMesh& a, const HexMesh& b);

}  // namespace breast
