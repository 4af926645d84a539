// Template nodes put into a body: hull nodes on the sheets, the rest by a graph Laplace equation.
#pragma once

#include <vector>

#include "meshing/body_map.hpp"
#include "meshing/dome.hpp"

namespace breast {

/// Node positions and what each node may slide on.
struct PlacedNodes {
  std::vector<Vec3> x;  ///< mm
  std::vector<Support>
      support;           ///< skin and wall nodes slide in st; cut nodes (rims too) are fixed
  std::vector<Vec2> st;  ///< parameters of skin and wall nodes
};

/// Hull nodes at their places; the wall's disc, then the inside, by Laplace with graph weights.
/// Throws Error (failed) when a system cannot be solved.
PlacedNodes place_nodes(const DomeTemplate& dome, const BodyMap& body);

}  // namespace breast
