// SPDX-License-Identifier: GPL-3.0-or-later
// How an element is deformed from the stress-free shape to another.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/shape.hpp"

namespace breast {

/// The deformation gradient F = ∂x/∂X of an element at a point. `reference` and `deformed` hold the positions (mm) of
/// all nodes in the two shapes.
Mat3 deformation_gradient(const HexMesh& mesh, int element, const HexShape& shape,
                          const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed);

/// Left Cauchy–Green tensor of an element at its centre, without the change of volume: det b = 1.
Mat3 isochoric_stretch_at_centre(const HexMesh& mesh, int element,
                                 const std::vector<Vec3>& reference,
                                 const std::vector<Vec3>& deformed);

}  // namespace breast
