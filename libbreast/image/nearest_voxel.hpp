// SPDX-License-Identifier: GPL-3.0-or-later
// Look-up of the voxel around a patient point.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <cstddef>

#include "image/volume.hpp"

namespace breast {

/// Finds voxels by their nearest centre; the inverse of the directions is computed once.
class NearestVoxel {
 public:
  explicit NearestVoxel(const Grid& grid) : grid_(grid), to_index_(grid.direction.inverse()) {}

  /// Offset of the voxel in the grid's arrays; -1 outside the grid.
  std::ptrdiff_t at(const Vec3& patient) const {
    const Vec3 index = (to_index_ * (patient - grid_.origin)).cwiseQuotient(grid_.spacing);
    if (!index.allFinite() || index.cwiseAbs().maxCoeff() > 1e6) return -1;
    const int i = int(std::lround(index.x())), j = int(std::lround(index.y())),
              k = int(std::lround(index.z()));
    return grid_.contains(i, j, k) ? std::ptrdiff_t(grid_.offset(i, j, k)) : -1;
  }
  /// Half of a voxel's width in the unit direction `way`, mm.
  double half_width(const Vec3& way) const {
    return 0.5 * (to_index_ * way).cwiseAbs().dot(grid_.spacing);
  }

 private:
  Grid grid_;
  Mat3 to_index_;
};

}  // namespace breast
