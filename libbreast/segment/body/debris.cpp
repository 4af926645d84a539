// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/body/debris.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "segment/body/slices.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/itk_filters.hpp"

namespace breast {

namespace {

constexpr double opening = 3.5;  // mm: radius of the disc
constexpr double standing = 2;   // mm: less is the roundness of the skin itself
constexpr double spared = 20;    // mm about the most anterior points

Volume<float> smooth_within(const Mask& body, const Volume<float>& scan) {
  constexpr double smoothing = 1.5;  // mm
  Volume<float> tissue(scan.grid);
  for (std::size_t n = 0; n < tissue.voxels.size(); ++n)
    tissue.voxels[n] = body.voxels[n] ? scan.voxels[n] : 0;
  return gaussian(tissue, smoothing);
}

/// What is not much dimmer than the brightest tissue around it: skin and fat enclose the rest of the body.
Mask shell_of(const Mask& body, const Volume<float>& scan) {
  constexpr double neighbourhood = 75, gap = 2.5;  // mm
  constexpr float haze = 0.07f;
  const Volume<float> tissue = smooth_within(body, scan);
  const Volume<float> brightest =
      resampled(box_maximum(coarsened(tissue, {4, 4, 2}), neighbourhood), scan.grid);
  Mask shell(scan.grid);
  for (std::size_t n = 0; n < shell.voxels.size(); ++n)
    shell.voxels[n] = body.voxels[n] && tissue.voxels[n] > haze * brightest.voxels[n];
  close_slices(shell, gap);
  return shell;
}

/// What is reached from the front by steps backwards and sideways: where the view cuts the shell, the way into the
/// body does not lead forward again.
Mask air_from_front(const Mask& shell) {
  const auto& size = shell.grid.size;
  Mask air(shell.grid);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i)
        air.at(i, j, k) = !shell.at(i, j, k) && (j == 0 || air.at(i, j - 1, k));
      for (int i = 1; i < size[0]; ++i)
        if (air.at(i - 1, j, k) && !shell.at(i, j, k)) air.at(i, j, k) = 1;
      for (int i = size[0] - 2; i >= 0; --i)
        if (air.at(i + 1, j, k) && !shell.at(i, j, k)) air.at(i, j, k) = 1;
    }
  }
  return air;
}

/// Most anterior voxel of a range of columns; i = -1 when it is empty.
std::array<int, 3> most_anterior(const Mask& body, int first, int last) {
  const Grid& grid = body.grid;
  for (int j = 0; j < grid.size[1]; ++j) {
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int i = first; i <= last; ++i) {
        if (body.at(i, j, k)) return {i, j, k};
      }
    }
  }
  return {-1, 0, 0};
}

}  // namespace

double remove_debris(Mask& body, int midline) {
  const Grid& grid = body.grid;
  Volume<float> height(grid);
  const Components parts = components(opening_residue(body, opening, height));
  const std::array<std::array<int, 3>, 2> fronts{
      most_anterior(body, 0, midline), most_anterior(body, midline + 1, grid.size[0] - 1)};
  std::vector<char> debris(parts.count + 1, 0), nipple(parts.count + 1, 0);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::uint32_t part = parts.label[grid.offset(i, j, k)];
        if (part == 0) continue;
        if (height.at(i, j, k) > standing) debris[part] = 1;
        for (const auto& front : fronts) {
          const Vec3 away(i - front[0], j - front[1], k - front[2]);
          if (front[0] >= 0 && grid.spacing.cwiseProduct(away).norm() < spared) nipple[part] = 1;
        }
      }
    }
  }
  double taken = 0;
  for (std::size_t n = 0; n < body.voxels.size(); ++n) {
    const std::uint32_t part = parts.label[n];
    if (part == 0 || !debris[part] || nipple[part]) continue;
    body.voxels[n] = 0;
    taken += 1;
  }
  return taken * grid.voxel_volume() / mm3_per_ml;
}

void remove_haze(Mask& body, const Volume<float>& scan) {
  constexpr double skin = 1.5;  // mm
  Mask air = air_from_front(shell_of(body, scan));
  erode_slices(air, skin);
  for (std::size_t n = 0; n < body.voxels.size(); ++n)
    if (air.voxels[n]) body.voxels[n] = 0;
}

void remove_ghosts(Mask& body, const Volume<float>& scan) {
  constexpr double deepest = 25, neighbourhood = 15;  // mm
  constexpr float dim = 0.15f;
  const Grid& grid = body.grid;
  const Volume<float> brightest = box_maximum(smooth_within(body, scan), neighbourhood);
  Mask ghost(grid);
  for (std::size_t n = 0; n < ghost.voxels.size(); ++n)
    ghost.voxels[n] = body.voxels[n] && scan.voxels[n] < dim * brightest.voxels[n];
  // From the air inwards, a voxel of the axial slice at a time.
  std::vector<std::size_t> peeled;
  for (double depth = 0; depth < deepest; depth += grid.spacing[0]) {
    peeled.clear();
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int j = 1; j + 1 < grid.size[1]; ++j) {
        for (int i = 1; i + 1 < grid.size[0]; ++i) {
          const std::size_t n = grid.offset(i, j, k);
          if (!body.voxels[n] || !ghost.voxels[n]) continue;
          if (!body.at(i - 1, j, k) || !body.at(i + 1, j, k) || !body.at(i, j - 1, k) ||
              !body.at(i, j + 1, k))
            peeled.push_back(n);
        }
      }
    }
    if (peeled.empty()) break;
    for (const std::size_t n : peeled) body.voxels[n] = 0;
  }
}

}  // namespace breast
