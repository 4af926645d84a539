// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "segment/work.hpp"

namespace breast {

Mask interior_of(const Work& work, double skin_depth, double wall_margin) {
  Mask interior = work.breast;
  const Grid& grid = interior.grid;
  const double half_voxel = 0.25 * (grid.spacing[0] + grid.spacing[1]);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!interior.at(i, j, k)) continue;
        const bool skin = -work.skin_distance.at(i, j, k) + half_voxel < skin_depth;
        const bool wall = work.wall.depth.at(i, k) - j * grid.spacing[1] < wall_margin;
        if (skin || wall) interior.at(i, j, k) = 0;
      }
    }
  }
  return interior;
}

Mask near_unsure_wall(const Work& work, double reach) {
  Mask near(work.scan.grid);
  const Grid& grid = near.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double wall = work.wall.depth.at(i, k);
      if (!(work.wall.confidence.at(i, k) < 0.5)) continue;
      for (int j = 0; j < grid.size[1]; ++j) {
        const double ahead = wall - j * grid.spacing[1];
        near.at(i, j, k) = ahead > 0 && ahead < reach;
      }
    }
  }
  return near;
}

LabelVolume labels_of(const Work& work, Side side) {
  LabelVolume labels;
  const Grid& grid = work.scan.grid;
  labels.grid = grid;
  labels.side = side;
  labels.tissue.assign(grid.voxels(), std::uint8_t(Tissue::air));
  labels.fibroglandular_fraction = work.gland.fraction.voxels;
  labels.chest_wall_confidence.assign(grid.voxels(), 0);
  const double half_voxel = 0.25 * (grid.spacing[0] + grid.spacing[1]);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        const double wall = work.wall.depth.at(i, k);
        if (!std::isnan(wall))
          labels.chest_wall_confidence[n] = float(work.wall.confidence.at(i, k));
        if (!work.body.mask.voxels[n]) continue;
        Tissue tissue = Tissue::other;
        if (!std::isnan(wall) && j * grid.spacing[1] >= wall) {
          tissue = Tissue::muscle;
        } else if (work.breast.voxels[n]) {
          // At least the outermost voxel is skin.
          const double depth = -work.skin_distance.voxels[n] + half_voxel;
          tissue = depth < std::max(work.skin, 1.02 * half_voxel) ? Tissue::skin
                   : work.gland.lobes.voxels[n]                   ? Tissue::fibroglandular
                                                                  : Tissue::fat;
        }
        labels.tissue[n] = std::uint8_t(tissue);
        if (tissue != Tissue::fat && tissue != Tissue::fibroglandular)
          labels.fibroglandular_fraction[n] = 0;
      }
    }
  }
  labels.skin_thickness = work.skin;
  return labels;
}

TriMesh data_points(const Work& work) {
  TriMesh points;
  auto& surface = points.point_data["surface"];
  auto& confidence = points.point_data["confidence"];
  auto& sigma = points.point_data["sigma_mm"];
  const Grid& grid = work.scan.grid;
  const auto add = [&](const Vec3& index, double kind, double sure, double deviation) {
    points.points.push_back(grid.to_patient(index));
    surface.push_back(kind);
    confidence.push_back(sure);
    sigma.push_back(deviation);
  };
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!work.breast.at(i, j, k)) continue;
        for (const auto& s : face_neighbours) {
          if (!grid.contains(i + s[0], j + s[1], k + s[2]) ||
              work.body.mask.at(i + s[0], j + s[1], k + s[2]))
            continue;
          add(Vec3(i + 0.5 * s[0], j + 0.5 * s[1], k + 0.5 * s[2]), 0, 1, grid.spacing.norm() / 6);
        }
      }
    }
  }
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      if (!work.extent.columns[std::size_t(k) * grid.size[0] + i]) continue;
      add(Vec3(i, work.wall.depth.at(i, k) / grid.spacing[1], k), 1, work.wall.confidence.at(i, k),
          work.wall.sigma.at(i, k));
    }
  }
  return points;
}

}  // namespace breast
