// Tissue of the MR scan at points of the imaged shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "image/label_volume.hpp"
#include "mammo/attenuation.hpp"

namespace breast {

/// Tissues are interpolated trilinearly between voxels, fibroglandular tissue by its volume
/// fraction: a nearest-voxel look-up shows the voxel grid as a pattern in the mammogram. Voxels
/// labelled air, muscle or other lie inside the mesh only where mesh and labels disagree by part of
/// a voxel: taken as fat, and counted.
class VoxelTissue {
 public:
  /// Parts of fat, fibroglandular, skin, tumour (sum 1) and of unlabelled voxels; 8 for the vector
  /// unit.
  using Parts = Eigen::Array<float, 8, 1>;

  /// Copies the voxels within the box (mm, imaged shape): the part of the scan the mesh can ask
  /// for.
  VoxelTissue(const LabelVolume& labels, const Vec3& lower, const Vec3& upper);

  /// Voxel coordinates (of the copy) of a point in mm; affine.
  Vec3 index(const Vec3& imaged) const { return to_index_ * imaged + offset_; }
  Parts at(const Vec3& index) const;
  /// Tissue of `mm` millimetres of summed parts.
  static TissuePath path(const Parts& mm) { return {mm[0], mm[1], mm[2], mm[3]}; }
  static double unlabelled(const Parts& mm) { return mm[4]; }

 private:
  Mat3 to_index_;
  Vec3 offset_;
  std::array<int, 3> size_{1, 1, 1};
  std::vector<Parts> voxels_;
};

}  // namespace breast
