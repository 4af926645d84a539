// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue of the MR scan at points of the imaged shape.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "image/label_volume.hpp"
#include "projection/attenuation.hpp"

namespace breast {

/// Tissues are interpolated trilinearly between voxels, fibroglandular tissue by its volume
/// fraction, because a nearest-voxel look-up would show the voxel grid as a pattern in the
/// mammogram. Voxels labelled air, muscle or other lie inside the mesh only where mesh and labels
/// disagree by part of a voxel; they are taken as fat and counted.
class VoxelTissue {
 public:
  /// Fractions of fibroglandular tissue, skin, tumour, and unlabelled voxels; fat is the remainder
  /// of the first three.
  using Parts = Eigen::Array<float, 4, 1>;

  /// Copies the voxels within the box (mm, imaged shape), which is the part of the scan that the
  /// mesh needs.
  VoxelTissue(const LabelVolume& labels, const Vec3& lower, const Vec3& upper);

  /// Voxel coordinates (of the copy) of a point in mm; affine.
  Vec3 index(const Vec3& imaged) const { return to_index_ * imaged + offset_; }
  Parts at(const Vec3& index) const;
  /// Tissue of `mm` millimetres of parts summed over `length` mm.
  static TissuePath path(const Parts& mm, double length) {
    const double fat = length - double(mm[0]) - double(mm[1]) - double(mm[2]);
    return {std::max(0.0, fat), mm[0], mm[1], mm[2]};
  }
  static double unlabelled(const Parts& mm) { return mm[3]; }

 private:
  Mat3 to_index_;
  Vec3 offset_;
  Vec3 last_{0, 0, 0};  ///< largest voxel coordinates requested
  std::size_t row_ = 1, slice_ = 1;
  std::vector<Parts> voxels_;  ///< the last of every axis twice, so that each has a neighbour
};

inline VoxelTissue::Parts VoxelTissue::at(const Vec3& index) const {
  const Vec3 x = index.cwiseMax(0.0).cwiseMin(last_);
  const int i = int(x.x()), j = int(x.y()), k = int(x.z());
  const float fi = float(x.x() - i), fj = float(x.y() - j), fk = float(x.z() - k);
  const Parts* corner = &voxels_[std::size_t(k) * slice_ + std::size_t(j) * row_ + std::size_t(i)];
  const auto line = [fi](const Parts* p) -> Parts { return p[0] + fi * (p[1] - p[0]); };
  const auto plane = [&](const Parts* p) -> Parts {
    const Parts low = line(p);
    return low + fj * (line(p + row_) - low);
  };
  const Parts low = plane(corner);
  return low + fk * (plane(corner + slice_) - low);
}

}  // namespace breast
