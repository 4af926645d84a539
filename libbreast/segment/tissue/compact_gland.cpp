// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/compact_gland.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/elementary.hpp"
#include "core/units.hpp"
#include "segment/grid/itk_filters.hpp"

namespace breast {

namespace {

constexpr double block_mm = 4;  // wide enough for noise and thin strands to average out
// Change of log brightness from block to block that no coil makes: 3 % per mm.
constexpr double least_edge = 0.12;
constexpr double usual_changes = 3;  // of the median change, which a strong bias raises
// Across an edge the change of the coil's sensitivity is unknown. It is assumed to be zero, with this weight
// relative to the changes that are known.
constexpr double edge_weight = 0.1;
constexpr double least_step = 0.2;    // log brightness of fat over gland
constexpr double least_part_ml = 5;   // smaller glands do not mislead the estimate of the bias
constexpr double least_closed = 0.6;  // share of a part's boundary that must be an edge
constexpr double most_crossed = 0.1;  // share of the links inside it that may be one

/// Blocks of voxels: mean log brightness of their interior voxels, and which have any to speak of.
struct Blocks {
  Volume<float> level;
  std::vector<int> number;  ///< per block, or -1
  int count = 0;
};

/// Two neighbouring blocks and the change of log brightness from the first to the second.
struct Link {
  std::size_t from, to;
  int axis;
  double change;
  bool edge = false;
};

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

/// Marks the links that change too much for a coil, alone or, where an edge crosses a block, with the next link in
/// line. Of such a pair, a link with only a small part of the change is not marked.
void mark_edges(std::vector<Link>& links, double limit) {
  constexpr double of_pair = 5.0 / 3, least_part = 0.25;
  std::map<std::pair<std::size_t, int>, Link*> starting;  // by block and axis
  for (Link& link : links) starting[{link.from, link.axis}] = &link;
  for (Link& link : links) {
    if (std::abs(link.change) > limit) link.edge = true;
    const auto next = starting.find({link.to, link.axis});
    if (next == starting.end()) continue;
    Link& other = *next->second;
    const double both = std::abs(link.change + other.change);
    if (!(both > of_pair * limit)) continue;
    for (Link* one : {&link, &other})
      one->edge = one->edge || std::abs(one->change) > least_part * both;
  }
}

/// All links between neighbours.
std::vector<Link> links_of(const Blocks& blocks) {
  const Grid& grid = blocks.level.grid;
  std::vector<Link> links;
  std::vector<double> changes;
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
          changes.push_back(std::abs(links.back().change));
        }
      }
    }
  }
  if (links.empty()) return links;
  const auto middle = changes.begin() + std::ptrdiff_t(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  mark_edges(links, std::max(least_edge, usual_changes * *middle));
  return links;
}

/// The smooth field (log brightness) whose changes are those of the links that are no edges, by least
/// squares; of every block, by its number.
Eigen::VectorXd smooth_field(const Blocks& blocks, const std::vector<Link>& links) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(blocks.count);
  for (int n = 0; n < blocks.count; ++n) entries.emplace_back(n, n, 1e-6);  // the level is free
  for (const Link& link : links) {
    const int a = blocks.number[link.from], b = blocks.number[link.to];
    const double weight = link.edge ? edge_weight : 1, change = link.edge ? 0 : link.change;
    entries.emplace_back(a, a, weight);
    entries.emplace_back(b, b, weight);
    entries.emplace_back(a, b, -weight);
    entries.emplace_back(b, a, -weight);
    right[a] -= weight * change;
    right[b] += weight * change;
  }
  Eigen::SparseMatrix<double> laplacian(blocks.count, blocks.count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(
      laplacian);
  solver.setTolerance(1e-4);
  return solver.solve(right);
}

/// Log brightness of fat, which is the brightest, over that of every block, both over the smooth field.
std::vector<double> steps_below_fat(const Blocks& blocks, const Eigen::VectorXd& field) {
  constexpr double fat = 0.95;
  std::vector<double> steps(blocks.number.size(), 0), levels;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (blocks.number[n] < 0) continue;
    steps[n] = field[blocks.number[n]] - blocks.level.voxels[n];
    levels.push_back(-steps[n]);
  }
  const auto place = levels.begin() + std::ptrdiff_t(fat * double(levels.size() - 1));
  std::nth_element(levels.begin(), place, levels.end());
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (blocks.number[n] >= 0) steps[n] += *place;
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
        for (const auto& [a, b, c] :
             {std::array{i - 1, j, k}, std::array{i + 1, j, k}, std::array{i, j - 1, k},
              std::array{i, j + 1, k}, std::array{i, j, k - 1}, std::array{i, j, k + 1}}) {
          if (!grid.contains(a, b, c) || !dim.at(a, b, c)) inner.at(i, j, k) = 0;
        }
      }
    }
  }
  return inner;
}

/// Takes from `dim` the parts that are small, whose boundary is no edge, or whose inside edges cross.
void keep_enclosed(Mask& dim, const std::vector<Link>& links) {
  struct Count {
    double boundary = 0, closed = 0, inner = 0, crossed = 0;
  };
  const Components parts = components(dim);
  const Mask inside = inner_blocks(dim);
  std::vector<Count> counts(parts.count + 1);
  for (const Link& link : links) {
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

}  // namespace

DimTissue compact_gland(const Volume<float>& scan, const Mask& interior) {
  DimTissue gland{Volume<float>(scan.grid)};
  const Blocks blocks = blocks_of(scan, interior);
  if (blocks.count == 0) return gland;
  const std::vector<Link> links = links_of(blocks);
  const std::vector<double> steps = steps_below_fat(blocks, smooth_field(blocks, links));
  Mask dim(blocks.level.grid);
  for (std::size_t n = 0; n < steps.size(); ++n) dim.voxels[n] = steps[n] > least_step;
  keep_enclosed(dim, links);
  Volume<float> found(dim.grid);
  double count = 0;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (!dim.voxels[n]) continue;
    found.voxels[n] = 1;
    gland.step += steps[n];
    count += 1;
  }
  gland.step /= std::max(count, 1.0);
  gland.share = resampled(found, scan.grid);
  return gland;
}

}  // namespace breast
