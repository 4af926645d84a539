// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/expected.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {

namespace {

// Of 77 walls of known tissue, those of confidence nought would be that far off, by regression
// (docs/validation/geometry.md).
constexpr double unseen_off = 5;  // mm
constexpr double mean_of_deviation =
    0.8;  // mean distance over standard deviation of a normal distribution

bool covered(const Work& work, int i, int k) {
  const int nx = work.wall.depth.nx;
  return i >= 0 && i < nx && k >= 0 && k < work.wall.depth.nz &&
         work.extent.columns[std::size_t(k) * nx + i] != 0;
}

/// Rise of the wall (mm) from a column to the next along x or z, of those that the breast covers.
double rise(const Work& work, int i, int k, int across, int along) {
  const int behind = covered(work, i - across, k - along),
            ahead = covered(work, i + across, k + along);
  if (behind + ahead == 0) return 0;
  return (work.wall.depth.at(i + ahead * across, k + ahead * along) -
          work.wall.depth.at(i - behind * across, k - behind * along)) /
         (behind + ahead);
}

}  // namespace

double expected_wall_mm(const Work& work) {
  // At the side the wall runs backwards almost along its column, whose length then measures no distance from it. Its
  // rise counts up to an angle of about 75 degrees.
  constexpr double steepest = 4;
  const Vec3& spacing = work.scan.grid.spacing;
  double sum = 0, count = 0;
  for (int k = 0; k < work.wall.depth.nz; ++k) {
    for (int i = 0; i < work.wall.depth.nx; ++i) {
      if (!covered(work, i, k)) continue;
      const double across = std::clamp(rise(work, i, k, 1, 0), -steepest * spacing[0],
                                       steepest * spacing[0]),
                   along = std::clamp(rise(work, i, k, 0, 1), -steepest * spacing[2],
                                      steepest * spacing[2]);
      // Within a voxel the wall lies anywhere: the variance of an even distribution is a twelfth of its width's square.
      const double variance = (spacing[1] * spacing[1] + across * across + along * along) / 12;
      sum += mean_of_deviation * std::sqrt(variance) +
             unseen_off * (1 - work.wall.confidence.at(i, k));
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

double expected_breast_dice(const Work& work, double cut_by_view_cm2) {
  const Grid& grid = work.breast.grid;
  double volume = 0, missed = 0, columns = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      columns += covered(work, i, k);
      for (int j = 0; j < grid.size[1]; ++j) {
        if (!work.breast.at(i, j, k)) continue;
        volume += grid.voxel_volume();
        for (const auto& s : face_neighbours) {
          const int a = i + s[0], b = j + s[1], c = k + s[2];
          if (!grid.contains(a, b, c) || work.breast.at(a, b, c)) continue;
          const bool wall =
              work.body.mask.at(a, b, c) && b * grid.spacing[1] >= work.wall.depth.at(a, c);
          if (!wall) missed += 0.25 * grid.voxel_volume();  // along one face
        }
      }
    }
  }
  if (!(volume > 0)) return 0;
  missed += columns * grid.spacing[0] * grid.spacing[2] * expected_wall_mm(work);
  // Half a ball of the breast's volume, cut by a plane.
  const double radius = std::cbrt(1.5 * volume / std::numbers::pi),
               cut = cut_by_view_cm2 * mm2_per_cm2;
  missed += cut * cut / (4 * std::numbers::pi * radius);
  return std::max(0.0, 1 - missed / (2 * volume));
}

}  // namespace breast
