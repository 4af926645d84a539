// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/elementary.hpp"
#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

constexpr double block_mm = 4;
constexpr double least_edge = 0.08;  // change of log brightness from block to block
constexpr double usual_changes = 3;  // of the median

std::array<int, 3> voxels_of_a_block(const Grid& grid) {
  std::array<int, 3> factor{};
  for (int d = 0; d < 3; ++d) factor[d] = std::max(1, int(std::lround(block_mm / grid.spacing[d])));
  return factor;
}

}  // namespace

Blocks blocks_of(const Volume<float>& scan, const Mask& interior) {
  const std::array<int, 3> factor = voxels_of_a_block(scan.grid);
  Volume<float> inside(scan.grid), logs(scan.grid);
  for (std::size_t n = 0; n < scan.voxels.size(); ++n) {
    if (!interior.voxels[n] || !(scan.voxels[n] > 0)) continue;
    inside.voxels[n] = 1;
    logs.voxels[n] = elementary::log(scan.voxels[n]);
  }
  const Volume<float> share = coarsened(inside, factor);
  Blocks blocks{coarsened(logs, factor), std::vector<int>(share.voxels.size(), -1)};
  for (std::size_t n = 0; n < share.voxels.size(); ++n) {
    if (!(share.voxels[n] >= 0.5f)) continue;
    blocks.level.voxels[n] /= share.voxels[n];
    blocks.number[n] = blocks.count++;
  }
  return blocks;
}

Volume<float> in_blocks(const Volume<float>& volume) {
  return coarsened(volume, voxels_of_a_block(volume.grid));
}

std::vector<BlockLink> links_of(const Blocks& blocks) {
  const Grid& grid = blocks.level.grid;
  std::vector<BlockLink> links;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t from = grid.offset(i, j, k);
        if (blocks.number[from] < 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const int a = i + (axis == 0), b = j + (axis == 1), c = k + (axis == 2);
          if (!grid.contains(a, b, c) || blocks.number[grid.offset(a, b, c)] < 0) continue;
          const std::size_t to = grid.offset(a, b, c);
          links.push_back(
              {from, to, axis, double(blocks.level.voxels[to]) - blocks.level.voxels[from]});
        }
      }
    }
  }
  return links;
}

// A link is marked alone or, where an edge crosses a block, with the next link in line. Of such a
// pair, a link with only a small part of the change is not marked.
std::vector<BlockLink> links_with_edges(const Blocks& blocks) {
  constexpr double of_pair = 5.0 / 3, least_part = 0.25;
  std::vector<BlockLink> links = links_of(blocks);
  if (links.empty()) return links;
  std::vector<double> changes;
  for (const BlockLink& link : links) changes.push_back(std::abs(link.change));
  const double limit = std::max(least_edge, usual_changes * median(std::move(changes)));
  std::map<std::pair<std::size_t, int>, BlockLink*> starting;  // by block and axis
  for (BlockLink& link : links) starting[{link.from, link.axis}] = &link;
  for (BlockLink& link : links) {
    if (std::abs(link.change) > limit) link.edge = true;
    const auto next = starting.find({link.to, link.axis});
    if (next == starting.end()) continue;
    BlockLink& other = *next->second;
    const double both = std::abs(link.change + other.change);
    if (!(both > of_pair * limit)) continue;
    for (BlockLink* one : {&link, &other})
      one->edge = one->edge || std::abs(one->change) > least_part * both;
  }
  return links;
}

}  // namespace breast
