// SPDX-License-Identifier: GPL-3.0-or-later
// 27-node elements whose boundary nodes lie on the body's smooth surface.
#pragma once

#include "meshing/hull.hpp"

namespace breast {

struct CurveReport {
  int nodes = 0;           ///< boundary nodes between corners
  double largest_bow = 0;  ///< mm, from the straight face to the surface
  int held_back =
      0;  ///< number of these nodes not fully on the surface, because an element would fold or be badly shaped
          ///< shaped
  double largest_gap = 0;  ///< mm, largest remaining distance of such a node from the surface
};

/// Moves the mid-edge and mid-face nodes of a straight 27-node mesh (raise_order of the mesh of
/// `nodes`; corners stay) onto skin, chest wall and cut; edges where two of them meet follow the
/// rim. If corners are offset from the surface (layer of skin), so are the nodes between them, and
/// the inner side of a layer is curved like its outer side. Inner face and centre nodes follow by
/// transfinite interpolation (Gordon and Hall, Int J Numer Meth Eng 7:461, 1973). Every element is
/// then proved unfolded (jacobian_lower_bound); if less than a quarter of the straight element's
/// bound, or half of its scaled Jacobian, remains, the nodes of that element are moved half-way
/// back, and finally to the straight element.
CurveReport curve_boundary(const BodyMap& body, const PlacedNodes& nodes, HexMesh& mesh);

}  // namespace breast
