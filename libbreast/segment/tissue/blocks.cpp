// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.hpp"

namespace breast {

namespace {

constexpr double block_mm = 4;

}  // namespace

Blocks blocks_of(const Volume<float>& scan, const Mask& interior) {
  std::array<int, 3> factor{};
  for (int d = 0; d < 3; ++d)
    factor[d] = std::max(1, int(std::lround(block_mm / scan.grid.spacing[d])));
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

}  // namespace breast
