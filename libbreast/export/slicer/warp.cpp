// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/slicer/warp.hpp"

namespace breast {

Volume<float> warped(const Volume<float>& scan, const DisplacementField& field, float air) {
  Volume<float> image(field.grid, air);
  const auto& size = field.grid.size;
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const std::size_t at = field.grid.offset(i, j, k);
        if (field.part[at] != FieldPart::body) continue;
        const auto& u = field.vectors[at];
        const Vec3 place = field.grid.to_patient(Vec3(i, j, k)) + Vec3(u[0], u[1], u[2]);
        image.voxels[at] = float(sample_linear(scan, place, air));
      }
    }
  }
  return image;
}

Volume<std::uint8_t> part_volume(const DisplacementField& field) {
  Volume<std::uint8_t> volume(field.grid);
  for (std::size_t n = 0; n < field.part.size(); ++n)
    volume.voxels[n] = std::uint8_t(field.part[n]);
  return volume;
}

}  // namespace breast
