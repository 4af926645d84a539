// SPDX-License-Identifier: GPL-3.0-or-later
// Topology of the slab-and-half-ball template: node numbers and cells, without geometry.
#pragma once

#include <array>
#include <vector>

#include "phantom/parameters.hpp"

namespace breast {

/// Lattice of the template with all counts already multiplied by the element order. Slab nodes: a
/// disc (square core, then rings of the shell's and the skirt's thickness) on levels 0..slab. Dome
/// nodes above: the square core on levels 1..rise and shell layers around and on top of it.
class BlockLattice {
 public:
  /// Counts in elements; `order` 1 or 2.
  BlockLattice(const MeshParameters& size);

  /// Position of a node. For the slab, `ball` is its position on the slab's top disc of radius 1
  /// (fold) or up to 2 (rim), `level` in [0,1] from wall to top. For the dome, it is the position
  /// in the unit half ball.
  struct Place {
    bool dome = false;
    Vec3 ball{0, 0, 0};
    double level = 0;
    bool skin = false, wall = false;
  };
  const std::vector<Place>& places() const { return places_; }

  /// The elements, with (order+1)³ nodes each, first direction fastest, right-handed; and for each
  /// surface the elements and sides (VTK local faces) that lie on it.
  struct Side {
    int element, local;
  };
  std::vector<std::vector<int>> elements;
  std::vector<Side> skin, wall, cut;
  int nipple = 0;

 private:
  int slab_core(int i, int j, int level) const;
  int slab_ring(int t, int ring, int level) const;
  int core(int i, int j, int k) const;
  int side_shell(int t, int k, int layer) const;
  int top_shell(int i, int j, int layer) const;
  int perimeter_i(int t) const;
  int perimeter_j(int t) const;
  void place_nodes();
  void add_slab();
  void add_dome();
  Vec3 core_place(int i, int j, int k) const;
  Vec3 sphere_place(int i, int j, int k) const;

  int order_, c_, m_, s_, k_, l_;  ///< order; core, shell, skirt, slab, rise in lattice steps
  int slab_nodes_ = 0, core_nodes_ = 0, side_nodes_ = 0, disc_ = 0;
  std::vector<Place> places_;
};

}  // namespace breast
