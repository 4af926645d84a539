// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's own hexahedral template: a slab of fat on the chest wall, wider than the breast,
// and on it a half ball (square core and shell) that is the breast. `hexmesh` does not use this
// template, so that the chain is tested on a different mesh.
#pragma once

#include "mesh/hex_mesh.hpp"
#include "phantom/meridian.hpp"

namespace breast {

/// The stress-free mesh: points = imaged = reference, of order 1, or of order 2 with curved edges.
/// Skin, pectoral and cut faces are set; tissues are left to the caller. The nipple node lies where
/// the axis meets the skin. Throws Error (input) if an element is folded or `core` is odd.
HexMesh phantom_mesh(const BreastShape& shape, const MeridianMap& map, const MeshParameters& size);

}  // namespace breast
