// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/extent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "segment/grid/itk_filters.hpp"

namespace breast {

namespace {

bool on_side(int i, const TorsoFront& torso, Side side) {
  return side == Side::left ? i > torso.midline : i < torso.midline;
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

/// Tissue in front of the chest wall per column, mm: along the column and to the nearest air.
struct Thickness {
  HeightField column, normal;
  double sternal = 8;  ///< median over the sternum
};

Thickness thickness_before(const ChestWall& wall, const WallDomain& domain, const TorsoFront& torso,
                           const Volume<float>& skin_distance) {
  const Grid& grid = skin_distance.grid;
  Thickness found{HeightField(grid.size[0], grid.size[2], no_depth),
                  HeightField(grid.size[0], grid.size[2], no_depth)};
  std::vector<double> sternal;
  const int half = std::max(1, int(8 / grid.spacing[0]));
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      found.column.at(i, k) = wall.depth.at(i, k) - domain.skin.at(i, k);
      found.normal.at(i, k) = normal_thickness(skin_distance, wall, i, k);
      if (std::abs(i - torso.midline) > half || std::isnan(found.column.at(i, k))) continue;
      sternal.push_back(found.column.at(i, k));
    }
  }
  found.sternal = median(sternal, found.sternal);
  return found;
}

/// Greatest thickness of tissue on the side, mm.
double thickest_tissue(const Thickness& thickness, const WallDomain& domain,
                       const TorsoFront& torso, Side side) {
  double thickest = 0;
  for (int k = 0; k < thickness.normal.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (on_side(i, torso, side) && thickness.normal.at(i, k) > thickest)
        thickest = thickness.normal.at(i, k);
    }
  }
  if (!(thickest > thickness.sternal + 3)) {
    throw input_error("no breast stands out on the ", side_name(side), " side (greatest depth ",
                      thickest, " mm, sternum ", thickness.sternal, " mm)");
  }
  return thickest;
}

/// The thickest of the columns (i, k) that a breast may cover. The thickest tissue of all can lie
/// where the chest turns to the side, where none does, but not nearly all of the breast.
std::array<int, 2> thickest_covered(const std::vector<std::uint8_t>& columns,
                                    const HeightField& thickness, double thickest, Side side) {
  constexpr double least_share = 0.5;
  std::array<int, 2> place{-1, -1};
  double covered = 0;
  for (int k = 0; k < thickness.nz; ++k) {
    for (int i = 0; i < thickness.nx; ++i) {
      if (!columns[std::size_t(k) * thickness.nx + i] || !(thickness.at(i, k) > covered)) continue;
      covered = thickness.at(i, k);
      place = {i, k};
    }
  }
  if (!(covered > least_share * thickest)) {
    throw input_error("the chest wall behind the ", side_name(side),
                      " breast was not found: give --chest-wall");
  }
  return place;
}

/// Thickness of a column's neighbourhood (6 mm across and along); NaN without any.
double mean_thickness(const HeightField& thickness, const Grid& grid, int i, int k) {
  const int across = std::max(1, int(6 / grid.spacing[0])), along = int(6 / grid.spacing[2]);
  double sum = 0, count = 0;
  for (int c = std::max(k - along, 0); c <= std::min(k + along, grid.size[2] - 1); ++c) {
    for (int a = std::max(i - across, 0); a <= std::min(i + across, grid.size[0] - 1); ++a) {
      if (std::isnan(thickness.at(a, c))) continue;
      sum += thickness.at(a, c);
      count += 1;
    }
  }
  return count > 0 ? sum / count : no_depth;
}

/// Up to the clavicle the chest may be covered more thickly than where a breast ends below and
/// beside. Cranial of the thickest column a breast ends, as its fitted rim does, where tissue below
/// half of its greatest thickness thins by less than 15 degrees, when it runs on so for `reach`.
void end_cranially(std::vector<std::uint8_t>& columns, const HeightField& thickness,
                   const Grid& grid, double greatest, int thick_k) {
  constexpr double slope = 0.268, reach = 30;  // tan 15 degrees; mm
  const int nx = grid.size[0], nz = grid.size[2], ahead = int(std::ceil(reach / grid.spacing[2]));
  for (int i = 0; i < nx; ++i) {
    for (int k = thick_k + 1; k + ahead < nz; ++k) {
      const double here = mean_thickness(thickness, grid, i, k);
      if (!columns[std::size_t(k) * nx + i] || !columns[std::size_t(k + ahead) * nx + i] ||
          !(here < 0.5 * greatest) ||
          !(here - mean_thickness(thickness, grid, i, k + ahead) < slope * ahead * grid.spacing[2]))
        continue;
      for (int c = k; c < nz; ++c) columns[std::size_t(c) * nx + i] = 0;
      break;
    }
  }
}

/// The view ends in front of where the wall is sought, and not where the chest curves back: a wall found there is the
/// view's end, and what lies before it stands on the wall nevertheless.
bool ends_before_wall(const WallDomain& domain, const TorsoFront& torso, double spacing, int i,
                      int k) {
  const double aside = std::abs(i - torso.midline) * spacing;
  return aside < curving_back && domain.deepest.at(i, k) < torso.cleft[k] + sought_behind;
}

}  // namespace

BreastExtent find_extent(const ChestWall& wall, const WallDomain& domain, const TorsoFront& torso,
                         const Volume<float>& skin_distance, Side side, Posture posture) {
  const Grid& grid = skin_distance.grid;
  const int nx = grid.size[0], nz = grid.size[2];
  const Thickness measured = thickness_before(wall, domain, torso, skin_distance);
  const HeightField& thickness = measured.column;
  BreastExtent extent;
  extent.sternal_thickness = measured.sternal;
  const double thickest = thickest_tissue(measured, domain, torso, side);
  for (const double t : thickness.depth) {
    if (t > extent.greatest_thickness) extent.greatest_thickness = t;
  }
  extent.least_thickness =
      std::max({extent.sternal_thickness + 5, 0.2 * extent.greatest_thickness, 10.0});
  extent.columns.assign(std::size_t(nx) * nz, 0);
  const int step = std::max(1, int(6 / grid.spacing[0]));
  for (int k = 0; k < nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!on_side(i, torso, side)) continue;
      const bool turns_away = wall.depth.at(i, k) > domain.deepest.at(i, k) - 3 &&
                              !ends_before_wall(domain, torso, grid.spacing[0], i, k);
      if (turns_away && posture == Posture::prone) continue;
      const int a = std::max(i - step, domain.first), b = std::min(i + step, domain.last);
      const double slope =
          std::abs(wall.depth.at(b, k) - wall.depth.at(a, k)) / ((b - a) * grid.spacing[0]);
      // Where the chest curves away a column grazes it: its thickness
      // counts along the wall's normal.
      const bool steep = slope > 1.5 && posture == Posture::prone;
      const double least = extent.least_thickness * (turns_away ? 1 : std::hypot(1, slope));
      if (steep || !(thickness.at(i, k) > least)) continue;
      extent.columns[std::size_t(k) * nx + i] = 1;
    }
  }
  const auto [thick_i, thick_k] = thickest_covered(extent.columns, measured.normal, thickest, side);
  end_cranially(extent.columns, thickness, grid, measured.normal.at(thick_i, thick_k), thick_k);
  tidy(extent.columns, grid, thick_i, thick_k);
  for (int k = 0; k < nz; ++k) {
    for (int i = 0; i < nx; ++i) {
      if (!on_side(i, torso, side) || std::isnan(thickness.at(i, k)))
        extent.columns[std::size_t(k) * nx + i] = 0;
    }
  }
  return extent;
}

namespace {

constexpr double overhang_behind =
    20;  // mm behind the sternum's skin to which a breast may hang over

/// Columns in which a part hangs over: body in front of at least 4 mm of air in front of the
/// trunk's skin, and more than a column or two of it (ghosts of the chest's movement are not).
std::vector<std::uint8_t> overhanging(const Mask& body, const WallDomain& domain,
                                      const TorsoFront& torso, Side side) {
  const Grid& grid = body.grid;
  const int nx = grid.size[0], nz = grid.size[2];
  constexpr double gap = 4;  // mm
  std::vector<std::uint8_t> columns(std::size_t(nx) * nz, 0);
  for (int k = 0; k < nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!on_side(i, torso, side)) continue;
      const double skin = domain.skin.at(i, k), limit = torso.cleft[k] + overhang_behind;
      const double end = std::isnan(skin) ? limit : std::min(skin, limit);
      int j = std::clamp(int(end / grid.spacing[1]), 0, grid.size[1] - 1);
      int air = 0;
      for (; j >= 0 && !body.at(i, j, k); --j) ++air;
      columns[std::size_t(k) * nx + i] = j >= 0 && air * grid.spacing[1] >= gap;
    }
  }
  const cv::Mat map(nz, nx, CV_8U, columns.data());
  cv::morphologyEx(map, map, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE,
                                             {2 * std::max(1, int(4 / grid.spacing[0])) + 1, 1}));
  return columns;
}

/// Distances (mm) to the chest wall under the breast and to the rest of the wall.
struct WallDistances {
  Volume<float> covered, bare;
};

WallDistances wall_distances(const Grid& grid, const ChestWall& wall, const WallDomain& domain,
                             const BreastExtent& extent) {
  Mask covered(grid), bare(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      Mask& part = extent.columns[std::size_t(k) * grid.size[0] + i] ? covered : bare;
      for (int j = 0; j < grid.size[1]; ++j)
        part.at(i, j, k) = j * grid.spacing[1] >= wall.depth.at(i, k);
    }
  }
  return {signed_distance(covered), signed_distance(bare)};
}

/// First voxel of the body in a column from the front; the number of rows if there is none.
int first_of_body(const Mask& body, int i, int k) {
  int j = 0;
  while (j < body.grid.size[1] && !body.at(i, j, k)) ++j;
  return j;
}

/// Where the chest turns to the side, or a breast lies over its fold, a column through the end of
/// the breast cuts off what stands on the wall before it. That is added in front of folds (air
/// between it and the trunk), with what hangs there clear of the wall; elsewhere only when it is
/// more of the breast than the end of a column against that of a normal usually makes.
void add_beside_columns(Mask& breast, const Mask& body, const ChestWall& wall,
                        const WallDomain& domain, const TorsoFront& torso,
                        const BreastExtent& extent, Side side) {
  constexpr double usual_share = 0.08;
  const Grid& grid = breast.grid;
  const WallDistances distance = wall_distances(grid, wall, domain, extent);
  const auto whole = std::count(breast.voxels.begin(), breast.voxels.end(), 1);
  std::vector<std::size_t> beside;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!on_side(i, torso, side)) continue;
      const int first = first_of_body(body, i, k);
      const bool fold = !(first * grid.spacing[1] > domain.skin.at(i, k) - 1);
      for (int j = first; j < grid.size[1] && j * grid.spacing[1] < wall.depth.at(i, k); ++j) {
        const std::size_t n = grid.offset(i, j, k);
        if (!body.voxels[n] || breast.voxels[n]) continue;
        const bool stands_on = distance.covered.voxels[n] < distance.bare.voxels[n];
        const bool hangs = fold && distance.bare.voxels[n] > extent.least_thickness &&
                           j * grid.spacing[1] < torso.cleft[k] + overhang_behind;
        if (hangs || (fold && stands_on)) breast.voxels[n] = 1;
        if (stands_on && !fold) beside.push_back(n);
      }
    }
  }
  if (double(beside.size()) < usual_share * double(whole)) return;
  for (const std::size_t n : beside) breast.voxels[n] = 1;
}

}  // namespace

Mask breast_voxels(const Mask& body, const ChestWall& wall, const WallDomain& domain,
                   const TorsoFront& torso, const BreastExtent& extent, Side side,
                   Posture posture) {
  const Grid& grid = body.grid;
  Mask breast(grid);
  const std::vector<std::uint8_t> overhang = overhanging(body, domain, torso, side);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      if (!on_side(i, torso, side)) continue;
      const std::size_t column = std::size_t(k) * grid.size[0] + i;
      const double skin = domain.skin.at(i, k);
      for (int j = 0; j < grid.size[1]; ++j) {
        const double depth = j * grid.spacing[1];
        if (!body.at(i, j, k) || !(depth < wall.depth.at(i, k))) continue;
        const bool hangs = overhang[column] && (std::isnan(skin) || depth < skin) &&
                           depth < torso.cleft[k] + overhang_behind;
        breast.at(i, j, k) = extent.columns[column] || hangs;
      }
    }
  }
  if (posture == Posture::prone)
    add_beside_columns(breast, body, wall, domain, torso, extent, side);
  return largest_component(breast);
}

}  // namespace breast
