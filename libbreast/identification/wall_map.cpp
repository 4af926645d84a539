// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/wall_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"

namespace breast {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double surely_seen = 0.5, smoothing_mm = 5, least_tissue_mm = 6;

// The voxel at which muscle begins in a column; not a number without 6 mm of tissue in front of it,
// because no wall is sought there.
double front_of_muscle(const LabelVolume& labels, int i, int k) {
  const int before = int(std::ceil(least_tissue_mm / labels.grid.spacing[1]));
  for (int j = before; j < labels.grid.size[1]; ++j) {
    if (labels.at(i, j, k) != Tissue::muscle) continue;
    const bool tissue =
        labels.at(i, j - before, k) != Tissue::air && labels.at(i, j - 1, k) != Tissue::air;
    const bool sure = labels.chest_wall_confidence[labels.grid.offset(i, j, k)] > surely_seen;
    return tissue && sure ? j - 0.5 : nan;
  }
  return nan;
}

// Mean with Gaussian weights along one direction over the columns with a value.
void smooth(std::vector<double>& field, int count, int stride, int lines, int line_stride,
            double deviation) {
  const int reach = int(std::ceil(2.5 * deviation));
  std::vector<double> weight;
  for (int d = -reach; d <= reach; ++d)
    weight.push_back(elementary::exp(-0.5 * d * d / (deviation * deviation)));
  std::vector<double> line(static_cast<std::size_t>(count));
  for (int l = 0; l < lines; ++l) {
    const auto at = [&](int i) -> double& {
      return field[std::size_t(l) * std::size_t(line_stride) +
                   std::size_t(i) * std::size_t(stride)];
    };
    for (int i = 0; i < count; ++i) {
      double sum = 0, total = 0;
      for (int a = std::max(0, i - reach); a <= std::min(count - 1, i + reach); ++a) {
        if (std::isnan(at(a))) continue;
        const double w = weight[std::size_t(a - i + reach)];
        sum += w * at(a), total += w;
      }
      line[std::size_t(i)] = std::isnan(at(i)) ? nan : sum / total;
    }
    for (int i = 0; i < count; ++i) at(i) = line[std::size_t(i)];
  }
}

}  // namespace

WallMap::WallMap(const LabelVolume& labels)
    : grid_(labels.grid), nx_(labels.grid.size[0]), nz_(labels.grid.size[2]) {
  for (int k = 0; k < nz_; ++k)
    for (int i = 0; i < nx_; ++i) depth_.push_back(front_of_muscle(labels, i, k));
  smooth(depth_, nx_, 1, nz_, nx_, smoothing_mm / grid_.spacing[0]);
  smooth(depth_, nz_, nx_, nx_, 1, smoothing_mm / grid_.spacing[2]);
}

bool WallMap::seen(int i, int k) const {
  return i >= 0 && k >= 0 && i < nx_ && k < nz_ && !std::isnan(depth(i, k));
}

std::optional<WallMap::Distance> WallMap::distance(const Vec3& x) const {
  const Vec3 at = grid_.to_index(x);
  const int i = int(std::floor(at.x())), k = int(std::floor(at.z()));
  if (!(seen(i, k) && seen(i + 1, k) && seen(i, k + 1) && seen(i + 1, k + 1))) return {};
  const double s = at.x() - i, t = at.z() - k;
  const double a = depth(i, k), b = depth(i + 1, k), c = depth(i, k + 1), d = depth(i + 1, k + 1);
  const double height = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
  const Vec3& mm = grid_.spacing;
  const double across = ((1 - t) * (b - a) + t * (d - c)) * mm[1] / mm[0],
               along = ((1 - s) * (c - a) + s * (d - b)) * mm[1] / mm[2];
  const Vec3 normal = Vec3(-across, 1, -along).normalized();
  return Distance{(at.y() - height) * mm[1] * normal.y(), grid_.direction * normal};
}

std::vector<Vec3> WallMap::places(double spacing) const {
  const int across = std::max(1, int(std::lround(spacing / grid_.spacing[0]))),
            along = std::max(1, int(std::lround(spacing / grid_.spacing[2])));
  std::vector<Vec3> list;
  for (int k = along / 2; k < nz_; k += along)
    for (int i = across / 2; i < nx_; i += across)
      if (seen(i, k)) list.push_back(grid_.to_patient(Vec3(i, depth(i, k), k)));
  return list;
}

}  // namespace breast
