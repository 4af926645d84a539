// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion from 8-node to 27-node elements on the same geometry.
#pragma once

#include "mesh/hex_mesh.hpp"

namespace breast {

/// The same body with 27-node elements. New nodes have the trilinear positions of every nodal
/// field, so that shapes, landmarks and face sets are unchanged. A mesh of order 2 is returned
/// unchanged.
HexMesh raise_order(const HexMesh& mesh);

}  // namespace breast
