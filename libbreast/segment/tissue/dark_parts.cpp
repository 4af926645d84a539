// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/dark_parts.hpp"

#include <algorithm>

#include "segment/grid/itk_filters.hpp"

namespace breast {

namespace {

constexpr float darkest_tissue = 0.1f;  // of fat
constexpr double least_part = 300;      // mm3

/// Whether a neighbour (of six) is not in the mask; beyond the border of the grid there is none.
bool beside_mask(const Mask& mask, int i, int j, int k) {
  return std::ranges::any_of(face_neighbours, [&](const auto& s) {
    return mask.grid.contains(i + s[0], j + s[1], k + s[2]) &&
           !mask.at(i + s[0], j + s[1], k + s[2]);
  });
}

}  // namespace

DarkParts dark_parts(const Volume<float>& brightness, const Mask& mask) {
  const Grid& grid = mask.grid;
  DarkParts found{Mask(grid), Mask(grid)};
  Mask dark(grid);
  std::size_t count = 0;
  for (std::size_t n = 0; n < dark.voxels.size(); ++n) {
    dark.voxels[n] = mask.voxels[n] && brightness.voxels[n] < darkest_tissue;
    count += dark.voxels[n];
  }
  if (double(count) * grid.voxel_volume() < least_part) return found;
  const Components parts = components(dark);
  const std::vector<std::size_t> size = sizes(parts);
  std::vector<char> open(size.size(), 0);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::uint32_t part = parts.label[grid.offset(i, j, k)];
        if (part != 0 && !open[part] && beside_mask(mask, i, j, k)) open[part] = 1;
      }
    }
  }
  for (std::size_t n = 0; n < dark.voxels.size(); ++n) {
    const std::uint32_t part = parts.label[n];
    if (double(size[part]) * grid.voxel_volume() < least_part) continue;
    (open[part] ? found.open : found.enclosed).voxels[n] = 1;
  }
  return found;
}

}  // namespace breast
