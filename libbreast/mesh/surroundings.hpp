// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue around the breast that is meshed with it (elements of Tissue::other), to which the breast is
// attached instead of to supports at its lateral cut. It belongs neither to the breast's volume nor
// to its muscle.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

inline bool is_around_breast(const HexMesh& mesh, int element) {
  return mesh.tissue[std::size_t(element)] == Tissue::other;
}
/// Those of the faces that are faces of the breast.
std::vector<Face> of_breast(const HexMesh& mesh, const std::vector<Face>& faces);
/// The part of the mesh without the tissue around the breast (mesh/part.hpp). Throws Error (input) if
/// there is nothing else.
HexMesh breast_alone(HexMesh mesh);
/// Whether two meshes are of one breast: the same elements, but for the tissue around it.
bool have_same_breast(const HexMesh& a, const HexMesh& b);

}  // namespace breast
