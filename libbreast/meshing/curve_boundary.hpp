// SPDX-License-Identifier: GPL-3.0-or-later
// 27-node elements whose boundary nodes lie on the body's smooth surface.
#pragma once

#include "meshing/hull.hpp"

namespace breast {

struct CurveReport {
  int nodes = 0;           ///< boundary nodes between corners
  double largest_bow = 0;  ///< mm, from the straight face to the surface
  int held_back =
      0;  ///< of them, not all the way on the surface: an element would fold or be badly shaped
  double largest_gap = 0;  ///< mm that such a node stays short of the surface
};

/// Moves the mid-edge and mid-face nodes of a straight 27-node mesh (raise_order of the mesh of
/// `nodes`; corners stay) onto skin, chest wall and cut; edges where two of them meet follow the
/// rim. Where corners stand off the surface (layer of skin) so do the nodes between them, and a
/// layer's inner side bows as its outer. Face and centre nodes inside follow by transfinite
/// interpolation (Gordon and Hall, Int J Numer Meth Eng 7:461, 1973). Every element is then proved
/// unfolded (jacobian_lower_bound); where the proof leaves less than a quarter of the straight
/// element's bound, or curving half of its scaled Jacobian, the nodes of that element go half-way
/// back, at last to the straight element.
CurveReport curve_boundary(const BodyMap& body, const PlacedNodes& nodes, HexMesh& mesh);

}  // namespace breast
