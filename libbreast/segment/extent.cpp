#include "segment/extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "segment/filters.hpp"
#include "segment/itk_filters.hpp"

namespace breast {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double median(std::vector<double> values, double fallback) {
  if (values.empty()) return fallback;
  const auto place = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Distance from the wall to the nearest air: the tissue's thickness however the column grazes it.
double normal_thickness(const Volume<float>& skin_distance, const ChestWall& wall, int i, int k) {
  const int j = std::clamp(int(std::lround(wall.depth.at(i, k) / skin_distance.grid.spacing[1])), 0,
                           skin_distance.grid.size[1] - 1);
  return -skin_distance.at(i, j, k);
}

/// Opened, its component with the thickest column, holes filled, outline smoothed.
void tidy(std::vector<std::uint8_t>& columns, const Grid& grid, int thick_i, int thick_k) {
  const int border = 20, nx = grid.size[0], nz = grid.size[2];
  const auto disc = [&](double mm) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE,
                                     {2 * int(std::lround(mm / grid.spacing[0])) + 1,
                                      2 * int(std::lround(mm / grid.spacing[2])) + 1});
  };
  const cv::Mat raw(nz, nx, CV_8U, columns.data());
  cv::Mat map, labels;
  cv::copyMakeBorder(raw, map, border, border, border, border, cv::BORDER_REPLICATE);
  cv::morphologyEx(map, map, cv::MORPH_OPEN, disc(6));
  cv::morphologyEx(map, map, cv::MORPH_CLOSE, disc(10));
  cv::connectedComponents(map, labels, 4);
  map = labels == labels.at<int>(thick_k + border, thick_i + border);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(map, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(map, outlines, -1, 255, cv::FILLED);
  const cv::Mat inner = map(cv::Rect(border, border, nx, nz));
  for (int k = 0; k < nz; ++k) {
    for (int i = 0; i < nx; ++i) columns[std::size_t(k) * nx + i] = inner.at<uchar>(k, i) != 0;
  }
}

}  // namespace

BreastExtent find_extent(const ChestWall& wall, const WallDomain& domain, const Torso& torso,
                         const Volume<float>& skin_distance, Side side) {
  const Grid& grid = skin_distance.grid;
  const int nx = grid.size[0], nz = grid.size[2];
  BreastExtent extent;
  HeightField thickness(nx, nz, nan), normal(nx, nz, nan);
  std::vector<double> sternal;
  const int half = std::max(1, int(8 / grid.spacing[0]));
  for (int k = 0; k < nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      thickness.at(i, k) = wall.depth.at(i, k) - domain.skin.at(i, k);
      normal.at(i, k) = normal_thickness(skin_distance, wall, i, k);
      if (std::abs(i - torso.midline) > half || std::isnan(thickness.at(i, k))) continue;
      sternal.push_back(thickness.at(i, k));
    }
  }
  extent.sternal_thickness = median(sternal, 8);
  const auto on_side = [&](int i) {
    return side == Side::left ? i > torso.midline : i < torso.midline;
  };
  int thick_i = -1, thick_k = -1;
  double thickest = 0;
  for (int k = 0; k < nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!on_side(i) || !(normal.at(i, k) > thickest)) continue;
      thickest = normal.at(i, k);
      thick_i = i;
      thick_k = k;
    }
  }
  if (thick_i < 0 || !(thickest > extent.sternal_thickness + 3)) {
    throw input_error("no breast stands out on the ", side_name(side), " side (greatest depth ",
                      thickest, " mm, sternum ", extent.sternal_thickness, " mm)");
  }
  for (const double t : thickness.depth) {
    if (t > extent.greatest_thickness) extent.greatest_thickness = t;
  }
  extent.least_thickness =
      std::max({extent.sternal_thickness + 5, 0.2 * extent.greatest_thickness, 10.0});
  extent.columns.assign(std::size_t(nx) * nz, 0);
  const int step = std::max(1, int(6 / grid.spacing[0]));
  for (int k = 0; k < nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!on_side(i) || wall.depth.at(i, k) > domain.deepest.at(i, k) - 3) continue;
      const int a = std::max(i - step, domain.first), b = std::min(i + step, domain.last);
      const double slope =
          std::abs(wall.depth.at(b, k) - wall.depth.at(a, k)) / ((b - a) * grid.spacing[0]);
      // Where the chest curves away a column grazes it: its thickness counts along the wall's
      // normal.
      if (slope > 1.5 || !(thickness.at(i, k) > extent.least_thickness * std::hypot(1, slope)))
        continue;
      extent.columns[std::size_t(k) * nx + i] = 1;
    }
  }
  if (!extent.columns[std::size_t(thick_k) * nx + thick_i]) {
    throw input_error("the chest wall behind the ", side_name(side),
                      " breast was not found: give --chest-wall");
  }
  tidy(extent.columns, grid, thick_i, thick_k);
  for (int k = 0; k < nz; ++k) {
    for (int i = 0; i < nx; ++i) {
      if (!on_side(i) || std::isnan(thickness.at(i, k)))
        extent.columns[std::size_t(k) * nx + i] = 0;
    }
  }
  return extent;
}

Mask breast_voxels(const Mask& body, const ChestWall& wall, const WallDomain& domain,
                   const Torso& torso, const BreastExtent& extent, Side side) {
  const Grid& grid = body.grid;
  Mask breast(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (side == Side::left ? i <= torso.midline : i >= torso.midline) continue;
      const bool stands = extent.columns[std::size_t(k) * grid.size[0] + i];
      const double skin = domain.skin.at(i, k);
      for (int j = 0; j < grid.size[1]; ++j) {
        const double depth = j * grid.spacing[1];
        if (!body.at(i, j, k) || !(depth < wall.depth.at(i, k))) continue;
        // A part hanging over: body in front of the air in front of the trunk's skin.
        const bool hangs = (std::isnan(skin) || depth < skin) && depth < torso.cleft[k] + 20;
        breast.at(i, j, k) = stands || hangs;
      }
    }
  }
  return largest_component(breast);
}

Nipple find_nipple(const Mask& breast, const Mask& body) {
  const Grid& grid = breast.grid;
  Volume<float> filled(grid);
  for (std::size_t n = 0; n < filled.voxels.size(); ++n) filled.voxels[n] = body.voxels[n];
  const Volume<float> share = gaussian(filled, 4.5);
  Vec3 extreme(0, 1e9, 0);
  std::vector<Vec3> candidates;
  std::vector<float> convexity;
  for (int j = 0; j < grid.size[1]; ++j) {
    if ((j - 30 / grid.spacing[1]) * grid.spacing[1] > extreme[1]) break;
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!breast.at(i, j, k) || (j > 0 && body.at(i, j - 1, k))) continue;
        const Vec3 place = grid.spacing.cwiseProduct(Vec3(i, j - 0.5, k));
        // Several voxels may be equally far forward: their middle would need a second pass; the
        // most convex of them is found below anyway.
        if (place[1] < extreme[1]) extreme = place;
        candidates.push_back(place);
        convexity.push_back(share.at(i, j, k));
      }
    }
  }
  if (candidates.empty()) throw failed_error("the breast has no skin");
  double best = 1e9;
  Vec3 chosen = extreme;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    const double away = (candidates[n] - extreme).norm();
    if (away > 25) continue;
    // Depth behind the front breaks ties on a smooth dome: there the most anterior point is meant.
    const double score = convexity[n] + 0.02 * (candidates[n][1] - extreme[1]);
    if (score < best) {
      best = score;
      chosen = candidates[n];
    }
  }
  Nipple nipple;
  nipple.position = grid.to_patient(chosen.cwiseQuotient(grid.spacing));
  nipple.from_extreme = (chosen - extreme).norm();
  return nipple;
}

}  // namespace breast
