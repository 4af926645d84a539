// SPDX-License-Identifier: GPL-3.0-or-later
// Skin as the outermost layer of elements, inside the body.
#pragma once

#include "meshing/place.hpp"

namespace breast {

/// For a dome: moves the hull inwards by `thickness` (mm, along the sheet's normal; at the rim down
/// the cut), smooths the inner nodes, and inserts one layer of elements between the moved and the
/// old hull, as the last elements. The faces of the template are updated; the edge of the layer at
/// the rim joins the cut. Returns the elements of the layer. Throws Error (input) if the layer
/// takes half of the cut's height.
std::vector<int> add_skin_layer(double thickness, const BodyMap& body, DomeTemplate& dome,
                                PlacedNodes& nodes);

/// For a cuboid: the outermost elements get the given thickness, so that the number of elements
/// remains n²l as in the paper. Along the edges of the cuboid they are wedges with a flat outer
/// corner. Returns these elements.
std::vector<int> thin_skin_elements(double thickness, const BodyMap& body, const DomeTemplate& dome,
                                    PlacedNodes& nodes);

}  // namespace breast
