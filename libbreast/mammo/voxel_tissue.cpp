#include "mammo/voxel_tissue.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace breast {

VoxelTissue::VoxelTissue(const LabelVolume& labels) : labels_(labels) {
  const Mat3 scale = labels.grid.spacing.cwiseInverse().asDiagonal();
  to_index_ = scale * labels.grid.direction.inverse();
  offset_ = -to_index_ * labels.grid.origin;
}

void VoxelTissue::add(const Vec3& imaged, double length, TissuePath& mm, double& unlabelled) const {
  const Vec3 index = to_index_ * imaged + offset_;
  int base[3];
  double f[3];
  for (int k = 0; k < 3; ++k) {
    const int last = labels_.grid.size[k] - 1;
    const double x = std::clamp(index[k], 0.0, double(last));
    base[k] = std::min(int(x), std::max(0, last - 1));
    f[k] = x - base[k];
  }
  double nearest_weight = 0;
  bool nearest_unlabelled = true;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    int at[3];
    for (int k = 0; k < 3; ++k) {
      const int step = corner >> k & 1;
      weight *= step ? f[k] : 1 - f[k];
      at[k] = std::min(base[k] + step, labels_.grid.size[k] - 1);
    }
    if (!(weight > 0)) continue;
    const std::size_t voxel = labels_.grid.offset(at[0], at[1], at[2]);
    const auto tissue = static_cast<Tissue>(labels_.tissue[voxel]);
    const double part = weight * length;
    const bool known = tissue == Tissue::fat || tissue == Tissue::fibroglandular ||
                       tissue == Tissue::skin || tissue == Tissue::tumour;
    if (tissue == Tissue::skin) {
      mm.skin += part;
    } else if (tissue == Tissue::tumour) {
      mm.tumour += part;
    } else {
      const double gland = known ? labels_.fibroglandular_fraction[voxel] : 0;
      mm.fibroglandular += gland * part;
      mm.fat += (1 - gland) * part;
    }
    if (weight > nearest_weight) {
      nearest_weight = weight;
      nearest_unlabelled = !known;
    }
  }
  if (nearest_unlabelled) unlabelled += length;
}

}  // namespace breast
