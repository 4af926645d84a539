// Skin as the outermost layer of elements, inside the body.
#pragma once

#include "meshing/place.hpp"

namespace breast {

/// Moves the hull inwards by `thickness` (mm, along the sheet's normal; at the rim down the cut),
/// smooths the inside below it, and puts one layer of elements between the moved and the old
/// hull: its elements come last, their number is returned. Faces of the template are updated; the
/// layer's edge at the rim joins the cut.
int add_skin_layer(double thickness, const BodyMap& body, DomeTemplate& dome, PlacedNodes& nodes);

}  // namespace breast
