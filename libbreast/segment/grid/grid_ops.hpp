// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on volume grids: axes in patient order, coarsening, resampling, rotation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "image/volume.hpp"

namespace breast {

using Mask = Volume<std::uint8_t>;

/// Steps from a voxel to those with which it shares a face.
inline constexpr std::array<std::array<int, 3>, 6> face_neighbours = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// The same voxels with axes permuted and flipped so that i runs mostly to the patient's left, j to
/// posterior and k to superior. Every voxel keeps its position in the patient.
Volume<float> in_patient_order(Volume<float> volume);
/// Mean of blocks of factor[0] x factor[1] x factor[2] voxels; incomplete blocks at the far ends
/// are averaged over their existing voxels.
Volume<float> coarsened(const Volume<float>& volume, const std::array<int, 3>& factor);
/// The grid of the result of coarsened().
Grid coarsened_grid(const Grid& grid, const std::array<int, 3>& factor);
/// Trilinear values of `coarse` at the voxels of `fine`, which has parallel axes; values beyond the
/// border equal those on the border.
Volume<float> resampled(const Volume<float>& coarse, const Grid& fine);

/// Voxels of a volume from the first to the last, both within it.
struct VoxelBox {
  std::array<int, 3> first{}, last{};
};
/// The part of a volume in a box; every voxel keeps its position in the patient.
template <class Value>
Volume<Value> cropped(const Volume<Value>& volume, const VoxelBox& box) {
  Grid grid = volume.grid;
  grid.origin = volume.grid.to_patient(Vec3(box.first[0], box.first[1], box.first[2]));
  for (int d = 0; d < 3; ++d) grid.size[d] = box.last[d] - box.first[d] + 1;
  Volume<Value> out(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      const Value* from = &volume.at(box.first[0], box.first[1] + j, box.first[2] + k);
      std::copy(from, from + grid.size[0], &out.at(0, j, k));
    }
  }
  return out;
}

/// The grid rotated by `angle` (radians, i towards j) about its centre, and widened by as many voxels as hold the whole of it.
Grid rolled_grid(const Grid& grid, double angle);
/// Values of `volume` at the voxels of a rolled_grid() of its grid, linear in the plane of its
/// slices; all tissue keeps its position in the patient. Beyond the volume its border continues.
Volume<float> on_rolled_grid(const Volume<float>& volume, const Grid& grid);

}  // namespace breast
