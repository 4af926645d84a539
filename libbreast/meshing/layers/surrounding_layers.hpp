// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of elements around the breast, beyond its lateral cut.
#pragma once

#include "mesh/hex_mesh.hpp"

namespace breast {

/// The sheets of fit-hermite do not reach farther beyond a breast.
inline constexpr double most_surroundings_mm = 60;

struct Surroundings {
  double mean_mm = 0;  ///< mean width that was meshed
  double part = 1;     ///< of the width that the sheets have room for; less where it would fold
  int layers = 0;      ///< elements across this width
};

/// Adds layers of elements of Tissue::other beyond the cut of a mesh with a geometry, between the
/// continued sheets of skin and chest wall, up to `width` mm wide: as far as the margin of the skin
/// sheet, at least 6 mm, and less (down to a third) where elements would fold. Their outer faces become
/// the cut of the mesh; skin and chest wall continue over them, and so does a layer of muscle. Where
/// the elements fold at every width, the mesh stays as it is, and there are 0 layers.
Surroundings add_surroundings(double width, HexMesh& mesh);

}  // namespace breast
