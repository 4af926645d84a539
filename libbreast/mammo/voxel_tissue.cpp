#include "mammo/voxel_tissue.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace breast {

namespace {

VoxelTissue::Parts parts_of(Tissue tissue, float gland) {
  VoxelTissue::Parts parts = VoxelTissue::Parts::Zero();
  if (tissue == Tissue::skin) {
    parts[2] = 1;
  } else if (tissue == Tissue::tumour) {
    parts[3] = 1;
  } else if (tissue == Tissue::fat || tissue == Tissue::fibroglandular) {
    parts[0] = 1 - gland;
    parts[1] = gland;
  } else {
    parts[0] = parts[4] = 1;
  }
  return parts;
}

}  // namespace

VoxelTissue::VoxelTissue(const LabelVolume& labels, const Vec3& lower, const Vec3& upper) {
  const Mat3 scale = labels.grid.spacing.cwiseInverse().asDiagonal();
  to_index_ = scale * labels.grid.direction.inverse();
  offset_ = -to_index_ * labels.grid.origin;
  std::array<int, 3> first{0, 0, 0};
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
    size_[k] = end - first[k] + 1;
    offset_[k] -= first[k];
  }
  voxels_.resize(std::size_t(size_[0]) * size_[1] * size_[2]);
  std::size_t at = 0;
  for (int k = 0; k < size_[2]; ++k) {
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) {
        const std::size_t voxel = labels.grid.offset(first[0] + i, first[1] + j, first[2] + k);
        voxels_[at++] = parts_of(static_cast<Tissue>(labels.tissue[voxel]),
                                 labels.fibroglandular_fraction[voxel]);
      }
    }
  }
}

VoxelTissue::Parts VoxelTissue::at(const Vec3& index) const {
  std::size_t low[3], high[3];
  float f[3];
  for (int k = 0; k < 3; ++k) {
    const double x = std::clamp(index[k], 0.0, double(size_[k] - 1));
    low[k] = std::size_t(x);
    high[k] = std::min(low[k] + 1, std::size_t(size_[k] - 1));
    f[k] = float(x - double(low[k]));
  }
  const auto voxel = [&](std::size_t i, std::size_t j, std::size_t k) -> const Parts& {
    return voxels_[(k * size_[1] + j) * size_[0] + i];
  };
  const auto line = [&](std::size_t j, std::size_t k) -> Parts {
    return (1 - f[0]) * voxel(low[0], j, k) + f[0] * voxel(high[0], j, k);
  };
  const auto plane = [&](std::size_t k) -> Parts {
    return (1 - f[1]) * line(low[1], k) + f[1] * line(high[1], k);
  };
  return (1 - f[2]) * plane(low[2]) + f[2] * plane(high[2]);
}

}  // namespace breast
