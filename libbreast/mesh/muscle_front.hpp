// SPDX-License-Identifier: GPL-3.0-or-later
// The surface between the breast and the muscle behind it.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Faces of the breast's elements that lie on muscle; the chest-wall faces of a mesh that has no
/// muscle. Their outward normals point to the ribs.
std::vector<Face> muscle_front(const HexTopology& mesh);

/// Mean thickness of the layer of muscle in the imaged shape, mm; 0 without one.
double muscle_thickness(const HexMesh& mesh);

}  // namespace breast
