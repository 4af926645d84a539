// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/front_muscle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/units.hpp"
#include "segment/wall/cut_columns.hpp"
#include "segment/wall/min_cut.hpp"

namespace breast {

namespace {

constexpr double thickest = 25;         // mm of the layer, along the wall's normal
constexpr double clear_of_skin = 8;     // mm
constexpr double bright = 0.88;         // of fat: what is brighter is none of the layer
constexpr double per_mm = 0.1;          // cost of a mm of fat in the layer, gain of one of muscle
constexpr double thickness_cost = 0.1;  // of a slope of the layer's thickness, over 1 mm
constexpr double clear_of_limit = 3;    // mm: a wall there was held by the search, not found
constexpr double most_fat = 4;          // mm within the layer, in one piece
constexpr double least_layer = 5;       // mm along the normal: thinner is the blur of the wall
constexpr double at_side = 15;          // mm from the last column of the body

/// The columns of the cut in the slices that are searched.
struct Columns : CutColumns {
  int first_slice, slices;
};

/// Slope of the wall across the body, over 6 mm each way.
double slope_across(const ChestWall& wall, const WallDomain& domain, double spacing, int i, int k) {
  const int reach = std::max(1, int(6 / spacing));
  const int a = std::max(i - reach, domain.first), b = std::min(i + reach, domain.last);
  return b > a ? (wall.depth.at(b, k) - wall.depth.at(a, k)) / ((b - a) * spacing) : 0;
}

/// Thickness along a column of what is 1 mm thick along the wall's normal.
double obliqueness(const ChestWall& wall, const WallDomain& domain, double spacing, int i, int k) {
  return std::hypot(1, slope_across(wall, domain, spacing, i, k));
}

/// What a column shows along j.
struct Profile {
  std::vector<float> ratio;
  std::vector<char> skin;  ///< a slice runs along the skin there, as in the fold below the breast
};

/// Mean of a column in neighbouring slices. Columns beside it would blur a wall that is oblique to
/// them.
Profile profile_along(const Volume<float>& ratio, const Volume<float>* skin_distance, int i,
                      int k) {
  const auto& size = ratio.grid.size;
  Profile profile{std::vector<float>(std::size_t(size[1]), 0),
                  std::vector<char>(std::size_t(size[1]), 0)};
  const int first = std::max(k - 1, 0), last = std::min(k + 1, size[2] - 1);
  for (int c = first; c <= last; ++c)
    for (int j = 0; j < size[1]; ++j)
      profile.ratio[std::size_t(j)] += ratio.at(i, j, c) / float(last - first + 1);
  if (!skin_distance) return profile;
  // The outermost slice of the body is shared with skin.
  for (int c = std::max(first - 1, 0); c <= std::min(last + 1, size[2] - 1); ++c)
    for (int j = 0; j < size[1]; ++j)
      if (skin_distance->at(i, j, c) > 0) profile.skin[std::size_t(j)] = 1;
  return profile;
}

/// Costs of a layer of 0, 1, 2 ... voxels in front of the wall in a column; as many as may be.
std::vector<float> layer_costs(const ChestWall& wall, const Volume<float>& ratio,
                               const Volume<float>* skin_distance, const WallDomain& domain,
                               double sternal_skin, int i, int k) {
  const double step = ratio.grid.spacing[1], depth = wall.depth.at(i, k);
  std::vector<float> costs{0};
  const bool found = depth < domain.deepest.at(i, k) - clear_of_limit;
  if (!found || std::isnan(domain.skin.at(i, k))) return costs;
  const double oblique = obliqueness(wall, domain, ratio.grid.spacing[0], i, k);
  const double front = std::max(
      {depth - thickest * oblique, domain.skin.at(i, k) + clear_of_skin * oblique, sternal_skin});
  const Profile profile = profile_along(ratio, skin_distance, i, k);
  const double muscle = wall.muscle_ratio;
  double fat = 0;
  // The voxel at the wall is shared with what lies behind it.
  for (int j = int(std::floor(depth / step - 0.5)); j >= 0 && j * step > front; --j) {
    if (profile.skin[std::size_t(j)]) break;
    const float value = profile.ratio[std::size_t(j)];
    const double darkness = (bright - value) / (bright - muscle);
    fat = darkness < 0 ? fat + step / oblique : 0;
    // What lies in front of fat does not lie on the wall; what is far darker than muscle is air.
    if (fat > most_fat || value < 0.5 * muscle) break;
    costs.push_back(costs.back() -
                    float(per_mm * step / oblique * std::clamp(2 * darkness, -1.0, 1.0)));
  }
  return costs;
}

/// Thickness of the layer (mm along the column) at the columns of the cut.
std::vector<double> layer_thickness(const ChestWall& wall, const Volume<float>& ratio,
                                    const Volume<float>* skin_distance, const WallDomain& domain,
                                    const std::vector<double>& sternal_skin,
                                    const Columns& columns) {
  const Vec3& spacing = ratio.grid.spacing;
  SurfaceProblem problem;
  problem.nx = columns.count;
  problem.nz = columns.slices;
  problem.step_cost_x = thickness_cost * spacing[1] / (columns.stride * spacing[0]);
  problem.step_cost_z = thickness_cost * spacing[1] / spacing[2];
  problem.max_step_x = problem.max_step_z = int(2 * thickest / spacing[1]);
  problem.first = {0};
  problem.top.assign(std::size_t(columns.count) * columns.slices, 0);
  for (int k = 0; k < columns.slices; ++k) {
    for (int c = 0; c < columns.count; ++c) {
      const std::vector<float> costs = layer_costs(
          wall, ratio, skin_distance, domain, sternal_skin[std::size_t(columns.first_slice + k)],
          columns.at(c, domain), columns.first_slice + k);
      problem.cost.insert(problem.cost.end(), costs.begin(), costs.end());
      problem.first.push_back(problem.cost.size());
    }
  }
  std::vector<double> thickness;
  for (const int level : optimal_surface(problem)) thickness.push_back(level * spacing[1]);
  return thickness;
}

/// Takes from the layer the parts that do not reach the side of the body.
void keep_at_side(std::vector<double>& thickness, const ChestWall& wall, const WallDomain& domain,
                  const Columns& columns, double spacing) {
  cv::Mat layer(columns.slices, columns.count, CV_8U), parts;
  for (int k = 0; k < columns.slices; ++k)
    for (int c = 0; c < columns.count; ++c)
      layer.at<uchar>(k, c) =
          thickness[std::size_t(k) * columns.count + c] >
          least_layer *
              obliqueness(wall, domain, spacing, columns.at(c, domain), columns.first_slice + k);
  std::vector<char> kept(std::size_t(cv::connectedComponents(layer, parts, 4)), 0);
  const int reach = std::max(1, int(at_side / (columns.stride * spacing)));
  for (int k = 0; k < columns.slices; ++k) {
    int end = columns.count - 1;
    while (end > 0 && std::isnan(domain.skin.at(columns.at(end, domain), columns.first_slice + k)))
      --end;
    for (int c = std::max(0, end - reach); c <= end; ++c)
      kept[std::size_t(parts.at<int>(k, c))] = 1;
  }
  for (int k = 0; k < columns.slices; ++k) {
    for (int c = 0; c < columns.count; ++c) {
      const int part = parts.at<int>(k, c);
      if (part == 0 || !kept[std::size_t(part)]) thickness[std::size_t(k) * columns.count + c] = 0;
    }
  }
}

/// First and last slice with breast.
std::array<int, 2> slices_of(const BreastExtent& extent, const Grid& grid) {
  const auto has_breast = [&](int k) {
    const auto row = extent.columns.begin() + std::ptrdiff_t(k) * grid.size[0];
    return std::any_of(row, row + grid.size[0], [](auto column) { return column != 0; });
  };
  int first = 0, last = grid.size[2] - 1;
  while (first < last && !has_breast(first)) ++first;
  while (last > first && !has_breast(last)) --last;
  return {first, last};
}

}  // namespace

double include_front_muscle(ChestWall& wall, const Volume<float>& ratio,
                            const Volume<float>* skin_distance, const WallDomain& domain,
                            const BreastExtent& extent, const std::vector<double>& sternal_skin) {
  const Vec3& spacing = ratio.grid.spacing;
  const auto [first_slice, last_slice] = slices_of(extent, ratio.grid);
  const Columns columns{CutColumns(domain, spacing[0]), first_slice, last_slice - first_slice + 1};
  std::vector<double> thickness =
      layer_thickness(wall, ratio, skin_distance, domain, sternal_skin, columns);
  keep_at_side(thickness, wall, domain, columns, spacing[0]);
  double moved = 0;
  for (int k = 0; k < columns.slices; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      const double layer = columns.between(thickness, i, k, domain);
      if (!(layer > 0)) continue;
      wall.depth.at(i, first_slice + k) -= layer;
      moved += layer * spacing[0] * spacing[2];
    }
  }
  return moved / mm3_per_ml;
}

}  // namespace breast
