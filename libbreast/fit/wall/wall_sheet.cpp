// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/wall/wall_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "fit/sheet_fit.hpp"

namespace breast {

namespace {

constexpr double raster = 3.0;  // mm between columns

struct WallData {
  SheetData data;
  std::vector<double> prior;  // weight from the confidence
  std::vector<char> foot;     // 1 behind the breast's foot
  double coverage = 0;
};

/// y of the first crossing of 1/2 from the front, NaN if none.
double first_crossing(const OccupancyField& muscle, double x, double z, double y0, double y1) {
  const double step = 1.0;
  double before = muscle.value({x, y0, z});
  for (double y = y0 + step; y <= y1; y += step) {
    const double now = muscle.value({x, y, z});
    if (now >= 0.5) return y - step * (now - 0.5) / std::max(1e-9, now - before);
    before = now;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double confidence_at(const LabelVolume& labels, const Vec3& p) {
  if (labels.chest_wall_confidence.size() != labels.grid.voxels()) return 1;
  const Vec3 index = labels.grid.to_index(p);
  int at[3];
  for (int a = 0; a < 3; ++a)
    at[a] = std::clamp(int(std::lround(index[a])), 0, labels.grid.size[a] - 1);
  return labels.chest_wall_confidence[labels.grid.offset(at[0], at[1], at[2])];
}

WallData collect(const LabelVolume& labels, const BreastRegion& region, const Box& box) {
  const OccupancyField muscle(labels, box, 1.5, [](Tissue t) { return t == Tissue::muscle; });
  const Box view = field_of_view(labels.grid);
  WallData wall;
  int behind = 0, seen = 0;
  const int columns = int((box.high.x() - box.low.x()) / raster);
  const int rows = int((box.high.z() - box.low.z()) / raster);
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const double x = box.low.x() + (box.high.x() - box.low.x()) * c / columns;
      const double z = box.low.z() + (box.high.z() - box.low.z()) * r / rows;
      if (x < view.low.x() || x > view.high.x() || z < view.low.z() || z > view.high.z()) continue;
      const bool foot = x > region.foot.low.x() && x < region.foot.high.x() &&
                        z > region.foot.low.z() && z < region.foot.high.z();
      behind += foot;
      const double y = first_crossing(muscle, x, z, box.low.y(), box.high.y());
      if (!std::isfinite(y)) continue;
      seen += foot;
      const Vec3 p(x, y, z);
      wall.data.points.push_back(p);
      wall.data.st.push_back({double(c) / columns, double(r) / rows});
      wall.prior.push_back(0.1 + 0.9 * std::clamp(confidence_at(labels, p), 0.0, 1.0));
      wall.foot.push_back(foot);
    }
  wall.coverage = behind > 0 ? double(seen) / behind : 0;
  const std::size_t n = wall.data.points.size();
  wall.data.normals.assign(n, Vec3(0, -1, 0));
  wall.data.tangential.assign(n, 1);
  wall.data.fixed.assign(n, 1);
  wall.data.weights = wall.prior;
  return wall;
}

/// Distances across the wall (mm, positive in front) and its steepness cos^2 at every datum.
void residuals(const HermiteSheet& sheet, const SheetData& data, std::vector<double>& distance,
               std::vector<double>& cos2) {
  distance.resize(data.points.size());
  cos2.resize(data.points.size());
  for (std::size_t k = 0; k < data.points.size(); ++k) {
    const SheetPoint at = sheet.evaluate(data.st[k]);
    const double cosine = -at.normal().y();
    cos2[k] = cosine * cosine;
    distance[k] = (at.x.y() - data.points[k].y()) * cosine;
  }
}

double quantile_abs(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  for (double& v : values) v = std::abs(v);
  const auto n =
      std::ptrdiff_t(std::min(values.size() - 1, std::size_t(fraction * double(values.size()))));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[std::size_t(n)];
}

}  // namespace

WallSheet fit_wall(const LabelVolume& labels, const BreastRegion& region, int nu, int nv,
                   double smoothing_mm) {
  WallSheet wall;
  const double beyond = 25, depth = 80;
  wall.box.low = region.crop.low - Vec3(beyond, 0, beyond);
  wall.box.high = region.crop.high + Vec3(beyond, 0, beyond);
  wall.box.high.y() = std::min(field_of_view(labels.grid).high.y(), region.foot.high.y() + depth);
  WallData found = collect(labels, region, wall.box);
  wall.coverage = found.coverage;
  if (!(wall.coverage >= 0.2))
    throw input_error("labels: the chest wall (muscle) is visible behind only ",
                      100 * wall.coverage,
                      " % of the breast; at least 20 % are needed; see segment --chest-wall");

  const double length =
      std::sqrt((wall.box.high.x() - wall.box.low.x()) * (wall.box.high.z() - wall.box.low.z()));
  const double smoothing = elementary::pow(smoothing_mm / length, 4);
  std::vector<double> distance, cos2, of_foot;
  for (int round = 0; round < 6; ++round) {
    wall.sheet = solve_sheet(nu, nv, found.data, smoothing);
    residuals(wall.sheet, found.data, distance, cos2);
    of_foot.clear();
    for (std::size_t k = 0; k < distance.size(); ++k)
      if (found.foot[k]) of_foot.push_back(distance[k]);
    const double scale = std::max(0.7, 2.5 * 1.4826 * quantile_abs(of_foot, 0.5));
    double sum = 0, total = 0;
    for (std::size_t k = 0; k < distance.size(); ++k) {
      const double ratio = distance[k] / scale;
      // Cauchy weights: a column that ran through to the back must not pull.
      found.data.weights[k] = found.prior[k] * cos2[k] / (1 + ratio * ratio);
      if (found.foot[k]) sum += found.data.weights[k] * distance[k] * distance[k];
      if (found.foot[k]) total += found.data.weights[k];
    }
    wall.rms_mm = total > 0 ? std::sqrt(sum / total) : 0;
  }
  wall.residual_p95_mm = quantile_abs(of_foot, 0.95);
  return wall;
}

}  // namespace breast
