// Tissue of the MR scan at points of the imaged shape.
#pragma once

#include "image/label_volume.hpp"
#include "mammo/attenuation.hpp"

namespace breast {

/// Skin and tumour by the nearest voxel, fibroglandular tissue by its trilinearly interpolated
/// volume fraction, the rest fat. Voxels labelled air, muscle or other lie inside the mesh only
/// where mesh and labels disagree by part of a voxel: counted, and taken as fat.
class VoxelTissue {
 public:
  /// Keeps a reference to the labels.
  explicit VoxelTissue(const LabelVolume& labels);

  /// Adds `length` mm at an imaged point to the tissues there.
  void add(const Vec3& imaged, double length, TissuePath& mm, double& unlabelled) const;
  double smallest_spacing() const { return labels_.grid.spacing.minCoeff(); }

 private:
  double fibroglandular(const Vec3& index) const;

  const LabelVolume& labels_;
  Mat3 to_index_;
  Vec3 offset_;
};

}  // namespace breast
