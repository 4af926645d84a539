// SPDX-License-Identifier: GPL-3.0-or-later
// Skin as the outermost layer of elements, inside the body.
#pragma once

#include "meshing/place.hpp"

namespace breast {

/// Dome: moves the hull inwards by `thickness` (mm, along the sheet's normal; at the rim down the
/// cut), smooths the inside below it, and puts one layer of elements between the moved and the old
/// hull; its elements come last. Faces of the template are updated; the layer's edge at the rim
/// joins the cut. Returns the elements of the layer. Throws Error (input) when the layer takes half
/// of the cut's height.
std::vector<int> add_skin_layer(double thickness, const BodyMap& body, DomeTemplate& dome,
                                PlacedNodes& nodes);

/// Cuboid: the outermost elements become `thickness` thick, so that their number stays n²l as in
/// the paper. Along the cuboid's edges they are wedges with a flat outer corner. Returns them.
std::vector<int> thin_skin_elements(double thickness, const BodyMap& body, const DomeTemplate& dome,
                                    PlacedNodes& nodes);

}  // namespace breast
