// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "fit/slice_interpolation.hpp"

namespace breast {

namespace {

struct BreastVoxels {
  std::array<std::vector<double>, 3> coordinate;
  Vec3 front = Vec3::Constant(std::numeric_limits<double>::infinity());
};

BreastVoxels collect(const LabelVolume& labels) {
  BreastVoxels found;
  const Grid& g = labels.grid;
  for (int k = 0; k < g.size[2]; ++k)
    for (int j = 0; j < g.size[1]; ++j)
      for (int i = 0; i < g.size[0]; ++i) {
        if (!is_breast(labels.at(i, j, k))) continue;
        const Vec3 p = g.to_patient(Vec3(i, j, k));
        for (int a = 0; a < 3; ++a) found.coordinate[a].push_back(p[a]);
        if (p.y() < found.front.y()) found.front = p;
      }
  return found;
}

double quantile(std::vector<double>& values, double fraction) {
  const auto n = std::min(values.size() - 1, std::size_t(fraction * double(values.size())));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(n), values.end());
  return values[n];
}

/// The x coordinate of the cleft, where the front of the body lies deepest within the middle
/// heights of the breast. Sought from 15 mm inside the medial end of the breast to `reach` beyond
/// it; NaN if the body continues to recede (no second breast).
double cleft_position(const LabelVolume& labels, const Box& foot, double reach) {
  const double step = 3.0;
  const double medial = -lateral_sign(labels.side);  // direction in x towards the midline
  const double start = (medial < 0 ? foot.low.x() : foot.high.x()) - 15 * medial;
  const int columns = std::max(2, int((reach + 15) / step));
  const double z0 = 0.7 * foot.low.z() + 0.3 * foot.high.z();
  const double z1 = 0.3 * foot.low.z() + 0.7 * foot.high.z();
  const int rows = std::max(1, int((z1 - z0) / step));
  const double none = std::numeric_limits<double>::infinity();
  std::vector<double> front(std::size_t(columns) * rows, none);
  const Grid& g = labels.grid;
  for (int k = 0; k < g.size[2]; ++k)
    for (int j = 0; j < g.size[1]; ++j)
      for (int i = 0; i < g.size[0]; ++i) {
        if (labels.at(i, j, k) == Tissue::air) continue;
        const Vec3 p = g.to_patient(Vec3(i, j, k));
        const double c = (p.x() - start) * medial / step, r = (p.z() - z0) / step;
        if (c < 0 || c >= columns || r < 0 || r >= rows) continue;
        double& y = front[std::size_t(c) * rows + std::size_t(r)];
        y = std::min(y, p.y());
      }
  std::vector<double> mean(columns, none);
  for (int c = 0; c < columns; ++c) {
    double sum = 0;
    int count = 0;
    for (int r = 0; r < rows; ++r)
      if (front[std::size_t(c) * rows + r] < none) sum += front[std::size_t(c) * rows + r], ++count;
    if (count > 0) mean[c] = sum / count;
  }
  int best = -1;
  for (int c = 0; c < columns; ++c)
    if (mean[c] < none && (best < 0 || mean[c] > mean[best])) best = c;
  if (best < 0 || best >= columns - 2) return std::numeric_limits<double>::quiet_NaN();
  return start + (best + 0.5) * step * medial;
}

void smooth_axis(Volume<float>& volume, int axis, double sigma_voxels) {
  const int radius = std::max(1, int(std::ceil(3 * sigma_voxels)));
  std::vector<float> weight(2 * radius + 1);
  double sum = 0;
  for (int o = -radius; o <= radius; ++o)
    sum += weight[o + radius] =
        float(elementary::exp(-0.5 * o * o / (sigma_voxels * sigma_voxels)));
  for (float& w : weight) w = float(w / sum);
  const auto& size = volume.grid.size;
  const int n = size[axis];
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? size[0] : std::size_t(size[0]) * size[1];
  const std::size_t lines = volume.grid.voxels() / n;
#pragma omp parallel
  {
    std::vector<float> line(n);
#pragma omp for schedule(static)
    for (std::size_t l = 0; l < lines; ++l) {
      const std::size_t base = l / stride * stride * n + l % stride;
      for (int i = 0; i < n; ++i) line[i] = volume.voxels[base + i * stride];
      for (int i = 0; i < n; ++i) {
        float value = 0;
        for (int o = -radius; o <= radius; ++o)
          value += weight[o + radius] * line[std::clamp(i + o, 0, n - 1)];
        volume.voxels[base + i * stride] = value;
      }
    }
  }
}

}  // namespace

// Whether x lies between the inner four of the eight corners of the field of view.
Box field_of_view(const Grid& grid) {
  std::array<std::array<double, 8>, 3> corner{};
  for (int c = 0; c < 8; ++c) {
    const Vec3 index((c & 1) ? grid.size[0] - 1 : 0, (c & 2) ? grid.size[1] - 1 : 0,
                     (c & 4) ? grid.size[2] - 1 : 0);
    const Vec3 p = grid.to_patient(index);
    for (int a = 0; a < 3; ++a) corner[a][c] = p[a];
  }
  Box box;
  for (int a = 0; a < 3; ++a) {
    std::sort(corner[a].begin(), corner[a].end());
    box.low[a] = corner[a][3];
    box.high[a] = corner[a][4];
  }
  return box;
}

BreastRegion find_region(const LabelVolume& labels, double margin_mm) {
  BreastVoxels found = collect(labels);
  const std::size_t count = found.coordinate[0].size();
  const double volume = double(count) * labels.grid.voxel_volume() * 1e-3;
  if (count < 1000 || volume < 10)
    throw input_error(
        "labels: the ", side_name(labels.side), " breast has ", volume,
        " ml of fat, fibroglandular, skin and tumour voxels; at least 10 ml are needed; "
        "check --side in segment");
  BreastRegion region;
  region.breast_ml = volume;
  for (int a = 0; a < 3; ++a) {
    region.foot.low[a] = quantile(found.coordinate[a], 0.001);
    region.foot.high[a] = quantile(found.coordinate[a], 0.999);
  }
  const auto nipple = labels.landmarks.find("nipple");
  region.nipple_known = nipple != labels.landmarks.end();
  region.nipple = region.nipple_known ? nipple->second : found.front;
  if (!region.nipple.allFinite())
    throw input_error("labels: the nipple landmark is not finite: (", region.nipple.transpose(),
                      ")");

  const Box view = field_of_view(labels.grid);
  const double inside_view = -5.0, past_midline = 4.0;
  region.crop.low = region.foot.low.array() - margin_mm;
  region.crop.high = region.foot.high.array() + margin_mm;
  for (int a : {0, 2}) {
    region.crop.low[a] = std::max(region.crop.low[a], view.low[a] + inside_view);
    region.crop.high[a] = std::min(region.crop.high[a], view.high[a] - inside_view);
  }
  region.crop.high.y() = std::min(region.crop.high.y(), view.high.y() - inside_view);
  const double cleft = cleft_position(labels, region.foot, margin_mm + 5);
  if (std::isfinite(cleft)) {
    if (labels.side == Side::left)
      region.crop.low.x() = std::max(region.crop.low.x(), cleft - past_midline);
    else
      region.crop.high.x() = std::min(region.crop.high.x(), cleft + past_midline);
  }
  const Vec3 extent = region.crop.high - region.crop.low;
  if (!(extent.minCoeff() > 40))
    throw input_error("labels: the box around the breast inside the field of view is ", extent.x(),
                      " x ", extent.y(), " x ", extent.z(),
                      " mm, of which each must exceed 40 mm; the scan truncates the breast");
  return region;
}

OccupancyField::OccupancyField(const LabelVolume& labels, const Box& box, double smoothing_mm,
                               const std::function<bool(Tissue)>& counts)
    : smoothing_(smoothing_mm) {
  const Grid& g = labels.grid;
  const double pad = 4 * smoothing_mm + 4;
  Vec3 low = Vec3::Constant(1e30), high = -low;
  for (int c = 0; c < 8; ++c) {
    const Vec3 corner((c & 1) ? box.high.x() + pad : box.low.x() - pad,
                      (c & 2) ? box.high.y() + pad : box.low.y() - pad,
                      (c & 4) ? box.high.z() + pad : box.low.z() - pad);
    const Vec3 index = g.to_index(corner);
    low = low.cwiseMin(index);
    high = high.cwiseMax(index);
  }
  std::array<int, 3> first{}, size{};
  for (int a = 0; a < 3; ++a) {
    first[a] = std::clamp(int(std::floor(low[a])), 0, g.size[a] - 1);
    size[a] = std::clamp(int(std::ceil(high[a])), first[a], g.size[a] - 1) - first[a] + 1;
  }
  Grid part = g;
  part.size = size;
  part.origin = g.to_patient(Vec3(first[0], first[1], first[2]));
  occupancy_ = Volume<float>(part);
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        occupancy_.at(i, j, k) =
            counts(labels.at(first[0] + i, first[1] + j, first[2] + k)) ? 1.f : 0.f;
  occupancy_ = fill_between_slices(occupancy_);
  for (int a = 0; a < 3; ++a)
    smooth_axis(occupancy_, a, std::max(0.6, smoothing_mm / occupancy_.grid.spacing[a]));
  front_ = field_of_view(g).low.y();
}

double OccupancyField::value(const Vec3& p) const {
  if (p.y() < front_) return 0;
  const Grid& g = occupancy_.grid;
  const Vec3 index = g.to_index(p);
  int base[3];
  double part[3];
  for (int a = 0; a < 3; ++a) {
    const double x = std::clamp(index[a], 0.0, double(g.size[a] - 1));
    base[a] = std::min(int(x), std::max(0, g.size[a] - 2));
    part[a] = x - base[a];
  }
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    const int i = base[0] + (c & 1), j = base[1] + ((c >> 1) & 1), k = base[2] + (c >> 2);
    const double w = ((c & 1) ? part[0] : 1 - part[0]) * ((c & 2) ? part[1] : 1 - part[1]) *
                     ((c & 4) ? part[2] : 1 - part[2]);
    if (w > 0) sum += w * occupancy_.at(i, j, k);
  }
  return sum;
}

Vec3 OccupancyField::gradient(const Vec3& p) const {
  const double h = std::max(0.5, 0.5 * smoothing_);
  Vec3 g;
  for (int a = 0; a < 3; ++a) {
    Vec3 d = Vec3::Zero();
    d[a] = h;
    g[a] = (value(p + d) - value(p - d)) / (2 * h);
  }
  return g;
}

}  // namespace breast
