// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue around the breast that is meshed with it (elements of Tissue::other), to which the breast is
// attached instead of to supports at its lateral cut. It belongs neither to the breast's volume nor
// to its muscle. Its elements and nodes come last: the breast alone is the beginning of every array.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

inline bool is_around_breast(const HexMesh& mesh, int element) {
  return mesh.tissue[std::size_t(element)] == Tissue::other;
}
/// Those of the faces that are faces of the breast.
std::vector<Face> of_breast(const HexMesh& mesh, const std::vector<Face>& faces);
/// The mesh without the tissue around the breast, which is cut off where the breast ends. Elements
/// and nodes keep their numbers; landmarks outside the breast are left out. Throws Error (input) if
/// that tissue does not come last.
HexMesh breast_alone(HexMesh mesh);
/// Whether two meshes are of one breast: the same elements, but for the tissue around it.
bool have_same_breast(const HexMesh& a, const HexMesh& b);

}  // namespace breast
