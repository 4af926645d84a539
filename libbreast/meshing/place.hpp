// SPDX-License-Identifier: GPL-3.0-or-later
// Placement of template nodes in a body: boundary nodes on the sheets, the others by a graph
// Laplace equation.
#pragma once

#include <vector>

#include "meshing/body_map.hpp"
#include "meshing/dome.hpp"

namespace breast {

/// Node positions and the surface on which each node may slide.
struct PlacedNodes {
  std::vector<Vec3> x;           ///< mm
  std::vector<Support> support;  ///< surface of each node; skin, wall and cut nodes slide in st
  std::vector<Vec2> st;          ///< skin, wall: the sheet's (s,t); cut: (u, height)
};

/// Whether a point of the cut lies on a rim: heights there are exactly 0 (wall) or 1 (skin).
inline bool on_rim(double height) {
  return height <= 0 || height >= 1;
}

/// Places boundary nodes on the hull. The nodes of the wall's disc, and then the interior nodes,
/// follow from a Laplace equation with graph weights. Throws Error (failed) if a system cannot be
/// solved.
PlacedNodes place_nodes(const DomeTemplate& dome, const BodyMap& body);

}  // namespace breast
