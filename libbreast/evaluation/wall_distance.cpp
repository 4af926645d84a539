// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/wall_distance.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "evaluation/overlap.hpp"
#include "image/nearest_voxel.hpp"

namespace breast {

namespace {

constexpr double lattice = 2, step = 0.2;  // mm
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Nearest label at a patient point; air outside the volume.
struct Sampler {
  explicit Sampler(const LabelVolume& of) : labels(of), nearest(of.grid) {}
  Tissue at(const Vec3& p) const {
    const std::ptrdiff_t voxel = nearest.at(p);
    return voxel < 0 ? Tissue::air : Tissue(labels.tissue[std::size_t(voxel)]);
  }
  const LabelVolume& labels;
  NearestVoxel nearest;
};

/// Patient box of the breast's voxels.
Eigen::AlignedBox3d breast_box(const LabelVolume& labels) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < labels.grid.size[2]; ++k) {
    for (int j = 0; j < labels.grid.size[1]; ++j) {
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        if (is_breast(labels.at(i, j, k))) box.extend(labels.grid.to_patient(Vec3(i, j, k)));
      }
    }
  }
  return box;
}

/// The position where the last run of breast along y ends in muscle; NaN if it does not.
double breast_end(const Sampler& labels, Vec3 p, double to) {
  double end = nan;
  bool inside = false;
  for (; p[1] < to; p[1] += step) {
    const Tissue tissue = labels.at(p);
    if (inside && !is_breast(tissue)) end = tissue == Tissue::muscle ? p[1] - 0.5 * step : nan;
    inside = is_breast(tissue);
  }
  return end;
}

struct FoundWall {
  double y = nan;              ///< the first muscle along y; NaN if there is none
  bool behind_breast = false;  ///< what lies directly in front of it is breast
};

FoundWall first_muscle(const Sampler& labels, Vec3 p, double to) {
  FoundWall found;
  for (; p[1] < to; p[1] += step) {
    const Tissue tissue = labels.at(p);
    if (tissue != Tissue::muscle) {
      found.behind_breast = is_breast(tissue);
      continue;
    }
    found.y = p[1] - 0.5 * step;
    break;
  }
  return found;
}

}  // namespace

WallDistance compare_walls(const LabelVolume& given, const LabelVolume& truth) {
  const Eigen::AlignedBox3d box = breast_box(truth);
  WallDistance result;
  if (box.isEmpty()) return result;
  const Sampler ours(given), theirs(truth);
  const Vec3 low = box.min();
  const int nx = int(box.sizes()[0] / lattice) + 1, nz = int(box.sizes()[2] / lattice) + 1;
  constexpr double reach = 60;  // mm behind the true breast
  std::vector<double> moved(std::size_t(nx) * nz, nan);
  std::vector<char> counted(moved.size(), 0), behind_breast(moved.size(), 0);
#pragma omp parallel for num_threads(threads()) schedule(dynamic)
  for (int k = 0; k < nz; ++k) {
    for (int i = 0; i < nx; ++i) {
      const Vec3 from(low[0] + i * lattice, low[1] - 2, low[2] + k * lattice);
      const double end = breast_end(theirs, from, box.max()[1] + 5);
      if (std::isnan(end)) continue;
      const std::size_t column = std::size_t(k) * nx + i;
      counted[column] = 1;
      const FoundWall found = first_muscle(ours, from, box.max()[1] + reach);
      moved[column] = found.y - end;
      behind_breast[column] = found.behind_breast;
    }
  }
  std::vector<double> sizes, on_breast;
  double missing = 0;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    if (!counted[n]) continue;
    result.columns += 1;
    if (std::isnan(moved[n])) {
      missing += 1;
      continue;
    }
    sizes.push_back(std::abs(moved[n]));
    if (behind_breast[n]) on_breast.push_back(sizes.back());
    result.bias_mm += moved[n];
  }
  if (result.columns > 0) result.missing_percent = 100 * missing / result.columns;
  if (sizes.empty()) return result;
  result.bias_mm /= double(sizes.size());
  result.distance = summarise(sizes);
  result.columns_on_breast = double(on_breast.size());
  if (!on_breast.empty()) result.on_breast = summarise(on_breast);
  return result;
}

}  // namespace breast
