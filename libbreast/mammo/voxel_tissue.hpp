// Tissue of the MR scan at points of the imaged shape.
#pragma once

#include "image/label_volume.hpp"
#include "mammo/attenuation.hpp"

namespace breast {

/// Tissues are interpolated trilinearly between voxels, fibroglandular tissue by its volume
/// fraction: a nearest-voxel look-up shows the voxel grid as a pattern in the mammogram. Voxels
/// labelled air, muscle or other lie inside the mesh only where mesh and labels disagree by part of
/// a voxel: taken as fat, and counted where the nearest voxel is one.
class VoxelTissue {
 public:
  /// Keeps a reference to the labels.
  explicit VoxelTissue(const LabelVolume& labels);

  /// Adds `length` mm at an imaged point to the tissues there.
  void add(const Vec3& imaged, double length, TissuePath& mm, double& unlabelled) const;
  double smallest_spacing() const { return labels_.grid.spacing.minCoeff(); }

 private:
  const LabelVolume& labels_;
  Mat3 to_index_;
  Vec3 offset_;
};

}  // namespace breast
