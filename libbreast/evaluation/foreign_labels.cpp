// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/foreign_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "image/nearest_voxel.hpp"

namespace breast {

void restrict_breast(LabelVolume& labels, const Volume<float>& region, int code) {
  const Grid& grid = labels.grid;
  const NearestVoxel nearest(region.grid);
  const auto inside = [&](const Vec3& patient) {
    const std::ptrdiff_t voxel = nearest.at(patient);
    if (voxel < 0) return false;
    const float value = region.voxels[std::size_t(voxel)];
    return code == 0 ? value != 0 : value == float(code);
  };
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        std::uint8_t& tissue = labels.tissue[grid.offset(i, j, k)];
        if (!is_breast(static_cast<Tissue>(tissue))) continue;
        if (!inside(grid.to_patient(Vec3(i, j, k)))) tissue = std::uint8_t(Tissue::other);
      }
    }
  }
}

namespace {

/// Faces of the breast's voxels against air within `reach` mm of a point.
std::vector<Vec3> faces_near(const LabelVolume& labels, const Vec3& point, double reach) {
  const Grid& grid = labels.grid;
  std::vector<Vec3> faces;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_breast(labels.at(i, j, k))) continue;
        const Vec3 centre = grid.to_patient(Vec3(i, j, k));
        if (!((centre - point).norm() < reach)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            std::array<int, 3> beside{i, j, k};
            beside[std::size_t(axis)] += step;
            if (!grid.contains(beside[0], beside[1], beside[2]) ||
                labels.at(beside[0], beside[1], beside[2]) != Tissue::air)
              continue;
            faces.push_back(centre + 0.5 * step * grid.spacing[axis] * grid.direction.col(axis));
          }
        }
      }
    }
  }
  return faces;
}

/// Mean of the skin's faces that are hardly farther away than the nearest (half the longest edge of
/// a voxel), so that the steps of thick slices do not matter; the point itself if there are none.
Vec3 nearest_skin(const LabelVolume& labels, const Vec3& point) {
  const std::vector<Vec3> faces = faces_near(labels, point, 15);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& face : faces) nearest = std::min(nearest, (face - point).norm());
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const Vec3& face : faces) {
    if ((face - point).norm() > nearest + 0.5 * labels.grid.spacing.maxCoeff()) continue;
    sum += face;
    count += 1;
  }
  return count > 0 ? Vec3(sum / count) : point;
}

}  // namespace

void restrict_to_side(LabelVolume& labels, Side side, double midline_mm) {
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double x = grid.to_patient(Vec3(i, j, k)).x();
        if (!is_breast(labels.at(i, j, k)) || lateral_sign(side) * (x - midline_mm) > 0) continue;
        labels.tissue[grid.offset(i, j, k)] = std::uint8_t(Tissue::other);
      }
    }
  }
}

std::optional<Vec3> skin_over_code(const Volume<float>& volume, int code,
                                   const LabelVolume& labels) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  const Grid& grid = volume.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (std::lround(volume.at(i, j, k)) != code || !is_breast(labels.at(i, j, k))) continue;
        sum += Vec3(i, j, k);
        count += 1;
      }
    }
  }
  if (count == 0) return std::nullopt;
  return nearest_skin(labels, grid.to_patient(sum / count));
}

}  // namespace breast
