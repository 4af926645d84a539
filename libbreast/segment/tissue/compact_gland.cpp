// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/compact_gland.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/percentile.hpp"
#include "core/units.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/tissue/coil_trend.hpp"

namespace breast {

namespace {

constexpr double least_step = 0.08;   // log brightness of fat over gland
constexpr double least_part_ml = 5;   // smaller glands do not mislead the estimate of the bias
constexpr double least_closed = 0.6;  // share of a part's boundary that must be an edge
constexpr double most_crossed = 0.1;  // share of the links inside it that may be one

/// Log brightness of fat, which is the brightest, over that of every block.
std::vector<double> steps_below_fat(const Blocks& blocks) {
  constexpr double fat = 0.95;
  std::vector<double> steps(blocks.number.size(), 0), levels;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (blocks.number[n] < 0) continue;
    steps[n] = -blocks.level.voxels[n];
    levels.push_back(blocks.level.voxels[n]);
  }
  if (levels.empty()) return steps;
  const double level = percentile(std::move(levels), fat);
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (blocks.number[n] >= 0) steps[n] += level;
  }
  return steps;
}

/// Blocks all of whose neighbours (of six) are in `dim`.
Mask inner_blocks(const Mask& dim) {
  Mask inner = dim;
  const Grid& grid = dim.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        for (const auto& s : face_neighbours) {
          const int a = i + s[0], b = j + s[1], c = k + s[2];
          if (!grid.contains(a, b, c) || !dim.at(a, b, c)) inner.at(i, j, k) = 0;
        }
      }
    }
  }
  return inner;
}

/// Takes from `dim` the parts that are small, whose boundary is no edge, or whose inside edges
/// cross.
void keep_enclosed(Mask& dim, const std::vector<BlockLink>& links) {
  struct Count {
    double boundary = 0, closed = 0, inner = 0, crossed = 0;
  };
  const Components parts = components(dim);
  const Mask inside = inner_blocks(dim);
  std::vector<Count> counts(parts.count + 1);
  for (const BlockLink& link : links) {
    const std::uint32_t a = parts.label[link.from], b = parts.label[link.to];
    Count& count =
        counts[std::max(a, b)];  // parts do not touch: one end is in this one, or both are
    if (a != b) {
      count.boundary += 1;
      count.closed += link.edge;
    } else if (inside.voxels[link.from] && inside.voxels[link.to]) {
      count.inner += 1;
      count.crossed += link.edge;
    }
  }
  const std::vector<std::size_t> size = sizes(parts);
  const auto kept = [&](std::uint32_t part) {
    const Count& count = counts[part];
    return double(size[part]) * dim.grid.voxel_volume() > least_part_ml * mm3_per_ml &&
           count.closed > least_closed * count.boundary &&
           count.crossed < most_crossed * count.inner;
  };
  for (std::size_t n = 0; n < dim.voxels.size(); ++n)
    dim.voxels[n] = parts.label[n] != 0 && kept(parts.label[n]);
}

/// Mean of the values of the blocks in `mask`; 0 if there are none.
double mean_in(const Mask& mask, const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (mask.voxels[n]) sum += values[n], count += 1;
  }
  return sum / std::max(count, 1.0);
}

}  // namespace

DimTissue compact_gland(const Volume<float>& scan, const Mask& interior) {
  DimTissue gland{Volume<float>(scan.grid)};
  Blocks blocks = blocks_of(scan, interior);
  if (blocks.count == 0) return gland;
  remove_coil_trend(blocks);
  const std::vector<BlockLink> links = links_with_edges(blocks);
  const std::vector<double> steps = steps_below_fat(blocks);
  Mask dim(blocks.level.grid);
  for (std::size_t n = 0; n < steps.size(); ++n) dim.voxels[n] = steps[n] > least_step;
  keep_enclosed(dim, links);
  // Blocks less than half of which are gland are not counted.
  const double half = 0.5 * mean_in(dim, steps);
  for (std::size_t n = 0; n < steps.size(); ++n) dim.voxels[n] = dim.voxels[n] && steps[n] > half;
  gland.step = mean_in(dim, steps);
  Volume<float> found(dim.grid);
  std::copy(dim.voxels.begin(), dim.voxels.end(), found.voxels.begin());
  gland.share = resampled(found, scan.grid);
  return gland;
}

}  // namespace breast
