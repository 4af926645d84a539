// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/voxel_tissue.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace breast {

namespace {

VoxelTissue::Parts parts_of(Tissue tissue, float gland) {
  VoxelTissue::Parts parts = VoxelTissue::Parts::Zero();
  if (tissue == Tissue::skin) {
    parts[1] = 1;
  } else if (tissue == Tissue::tumour) {
    parts[2] = 1;
  } else if (tissue == Tissue::fat || tissue == Tissue::fibroglandular) {
    parts[0] = gland;
  } else {
    parts[3] = 1;
  }
  return parts;
}

}  // namespace

VoxelTissue::VoxelTissue(const LabelVolume& labels, const Vec3& lower, const Vec3& upper) {
  const Mat3 scale = labels.grid.spacing.cwiseInverse().asDiagonal();
  to_index_ = scale * labels.grid.direction.inverse();
  offset_ = -to_index_ * labels.grid.origin;
  std::array<int, 3> first{0, 0, 0}, size{1, 1, 1};
  for (int k = 0; k < 3; ++k) {
    double low = offset_[k], high = offset_[k];  // of the box along index axis k
    for (int axis = 0; axis < 3; ++axis) {
      const double a = to_index_(k, axis) * lower[axis], b = to_index_(k, axis) * upper[axis];
      low += std::min(a, b);
      high += std::max(a, b);
    }
    const int last = labels.grid.size[k] - 1;
    first[k] = int(std::clamp(std::floor(low), 0.0, double(last)));
    const int end = int(std::clamp(std::ceil(high), double(first[k]), double(last)));
    size[k] = end - first[k] + 1;
    last_[k] = end - first[k];
    offset_[k] -= first[k];
  }
  row_ = std::size_t(size[0]) + 1;
  slice_ = row_ * (std::size_t(size[1]) + 1);
  voxels_.reserve(slice_ * (std::size_t(size[2]) + 1));
  for (int k = 0; k <= size[2]; ++k) {
    for (int j = 0; j <= size[1]; ++j) {
      for (int i = 0; i <= size[0]; ++i) {
        const std::size_t voxel = labels.grid.offset(first[0] + std::min(i, size[0] - 1),
                                                     first[1] + std::min(j, size[1] - 1),
                                                     first[2] + std::min(k, size[2] - 1));
        voxels_.push_back(parts_of(static_cast<Tissue>(labels.tissue[voxel]),
                                   labels.fibroglandular_fraction[voxel]));
      }
    }
  }
}

}  // namespace breast
