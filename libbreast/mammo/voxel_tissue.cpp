#include "mammo/voxel_tissue.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace breast {

VoxelTissue::VoxelTissue(const LabelVolume& labels) : labels_(labels) {
  const Mat3 scale = labels.grid.spacing.cwiseInverse().asDiagonal();
  to_index_ = scale * labels.grid.direction.inverse();
  offset_ = -to_index_ * labels.grid.origin;
}

double VoxelTissue::fibroglandular(const Vec3& index) const {
  int base[3];
  double f[3];
  for (int k = 0; k < 3; ++k) {
    const double x = std::clamp(index[k], 0.0, double(labels_.grid.size[k] - 1));
    base[k] = std::min(int(x), std::max(0, labels_.grid.size[k] - 2));
    f[k] = x - base[k];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    int at[3];
    for (int k = 0; k < 3; ++k) {
      const int step = corner >> k & 1;
      weight *= step ? f[k] : 1 - f[k];
      at[k] = std::min(base[k] + step, labels_.grid.size[k] - 1);
    }
    sum += weight * labels_.fibroglandular_fraction[labels_.grid.offset(at[0], at[1], at[2])];
  }
  return sum;
}

void VoxelTissue::add(const Vec3& imaged, double length, TissuePath& mm, double& unlabelled) const {
  const Vec3 index = to_index_ * imaged + offset_;
  const int i = int(std::lround(index.x())), j = int(std::lround(index.y())),
            k = int(std::lround(index.z()));
  const Tissue tissue = labels_.grid.contains(i, j, k) ? labels_.at(i, j, k) : Tissue::air;
  if (tissue == Tissue::skin) {
    mm.skin += length;
  } else if (tissue == Tissue::tumour) {
    mm.tumour += length;
  } else if (tissue == Tissue::fat || tissue == Tissue::fibroglandular) {
    const double fraction = fibroglandular(index);
    mm.fibroglandular += fraction * length;
    mm.fat += (1 - fraction) * length;
  } else {
    mm.fat += length;
    unlabelled += length;
  }
}

}  // namespace breast
