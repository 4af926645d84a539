// SPDX-License-Identifier: GPL-3.0-or-later
// Topology of the hexahedral templates: the half O-grid with a lateral cut ("dome") and, without
// outer layers, the paper's cuboid.
#pragma once

#include <array>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// A core of n × n × l elements on the chest wall, and m layers around its four sides and its top.
/// The lowest k rows of the sides' outer faces form the cut, and the other outer faces the skin.
/// There are n²l + m(n²+4nl) elements. m = 0 is the cuboid, on which the core's own faces are the
/// boundary of the body.
struct DomeSize {
  int n = 10, l = 10, m = 6, k = 3;
  int elements() const { return n * n * l + m * (n * n + 4 * n * l); }
};

/// The dome with the best proportions among those with about edge³ elements.
DomeSize dome_near(int edge);
/// Parses n, l, m, k as given by --dome: integers, m at least 1. Throws Error (input).
DomeSize dome_of(const std::vector<double>& numbers);
/// The paper's cuboid of edge³ elements, in which a quarter of the rows of side faces form the cut.
DomeSize cuboid_size(int edge);
/// Throws Error (input) unless n ≥ 2, l ≥ 2, m ≥ 0, 1 ≤ k < l and the size is
/// below 2 million elements.
void check_dome(const DomeSize& size);

/// Surface on which a template node lies.
enum class Support : std::uint8_t {
  interior,  ///< free in space
  skin,      ///< on the skin sheet
  wall,      ///< on the chest-wall sheet
  cut,       ///< on the cut surface, its two rims included
};

/// Position of a boundary node on the hull of the template.
struct HullPlace {
  Support support = Support::interior;
  double u = 0;       ///< position around the rim, [0,1); 0 is the core's corner i = j = 0
  double rho = 0;     ///< skin and wall: 0 at the pole, 1 at the rim
  double height = 0;  ///< cut: 0 at the wall, 1 at the skin
};

struct DomeTemplate {
  DomeSize size;
  std::vector<HullPlace> places;  ///< per node
  std::vector<int>
      connectivity;  ///< 8 per element, VTK order; ζ of the core points away from the wall
  std::vector<Face> skin_faces, wall_faces, cut_faces;
};
DomeTemplate dome_template(const DomeSize& size);

}  // namespace breast
