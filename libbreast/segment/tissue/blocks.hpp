// SPDX-License-Identifier: GPL-3.0-or-later
// The interior of a breast in blocks of a few millimetres, and how brightness changes between them.
#pragma once

#include <vector>

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Blocks of about 4 mm, wide enough for noise and thin strands to average out.
struct Blocks {
  Volume<float> level;      ///< mean log brightness of the voxels in the interior
  std::vector<int> number;  ///< per block, or -1 where less than half of it is interior
  int count = 0;            ///< of numbered blocks
};

/// Two neighbouring blocks.
struct BlockLink {
  std::size_t from, to;  ///< places in `Blocks::level`
  int axis;
  double change;      ///< of log brightness from the first to the second
  bool edge = false;  ///< the change is more than a coil makes
};

/// `scan` is brightness as scanned, on the grid of `interior`.
Blocks blocks_of(const Volume<float>& scan, const Mask& interior);

/// Mean of a volume on the scan's grid in every block.
Volume<float> in_blocks(const Volume<float>& volume);

/// All links between numbered neighbours.
std::vector<BlockLink> links_of(const Blocks& blocks);

/// All links between numbered neighbours, with the edges of tissue marked. At an edge, brightness
/// without the coil's trend (`remove_coil_trend`) changes by more than 2 % per mm and by more than
/// three times the median change, which noise and thin strands raise.
std::vector<BlockLink> links_with_edges(const Blocks& blocks);

}  // namespace breast
