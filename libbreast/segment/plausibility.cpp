// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/units.hpp"
#include "segment/tissue/skin_patch.hpp"

namespace breast {

double cut_by_view_cm2(const Mask& breast, const Mask& seen) {
  const Grid& grid = breast.grid;
  double area = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!breast.at(i, j, k)) continue;
        for (const auto& s : face_neighbours) {
          const int a = i + s[0], b = j + s[1], c = k + s[2];
          if (grid.contains(a, b, c) && (seen.voxels.empty() || seen.at(a, b, c) != 0)) continue;
          area += grid.voxel_volume() / std::abs(grid.spacing.dot(Vec3(s[0], s[1], s[2])));
        }
      }
    }
  }
  return area / mm2_per_cm2;
}

double flat_skin_cm2(const Work& work) {
  constexpr double radius = 10, flattest = 1.0 / 250, clear_of_wall = 30;  // mm
  const Grid& grid = work.scan.grid;
  const Vec3 extent = grid.spacing.cwiseProduct(Vec3(grid.size[0], grid.size[1], grid.size[2]));
  std::vector<SkinFace> faces;
  for (const SkinFace& face : skin_faces(work.body.mask, 0.5 * extent, extent.norm())) {
    const int i = std::clamp(int(std::lround(face.centre[0] / grid.spacing[0])), 0,
                             grid.size[0] - 1),
              k = std::clamp(int(std::lround(face.centre[2] / grid.spacing[2])), 0,
                             grid.size[2] - 1);
    const bool on_side = i >= work.domain.first && i <= work.domain.last;
    if (on_side &&
        face.centre[1] < std::min(work.wall.depth.at(i, k) - clear_of_wall, work.torso.cleft[k]))
      faces.push_back(face);
  }
  // Every n-th face stands for n; its neighbourhood is asked of the mask.
  const std::size_t stride = std::max<std::size_t>(1, faces.size() / 1500);
  std::vector<double> flat(faces.size(), 0);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t n = 0; n < faces.size(); n += stride) {
    const auto patch = skin_faces(work.body.mask, faces[n].centre, 1.3 * radius);
    const TangentFrame frame = tangent_frame(patch, faces[n].centre);
    const Quadric q = quadric_through(patch, frame, 0, radius);
    const double mean = q[3] + q[5], spread = std::hypot(q[3] - q[5], q[4]);
    if (std::abs(mean) + spread < flattest)
      flat[n] = double(stride) * std::max(0.0, faces[n].area.dot(frame.out));
  }
  return std::accumulate(flat.begin(), flat.end(), 0.0) / mm2_per_cm2;
}

namespace {

/// As Extents::view_behind_sternum_mm.
double view_behind_sternum(const Work& work) {
  const int nx = work.scan.grid.size[0], midline = work.torso.midline;
  std::vector<double> behind;
  for (int k = 0; k < work.scan.grid.size[2]; ++k) {
    int farthest = midline;
    for (int i = 0; i < nx; ++i)
      if (work.extent.columns[std::size_t(k) * nx + i] &&
          std::abs(i - midline) > std::abs(farthest - midline))
        farthest = i;
    if (farthest != midline)
      behind.push_back(work.domain.deepest.at(farthest, k) - work.torso.cleft[k]);
  }
  return median(std::move(behind), 0);
}

/// As Extents::front_left_out_percent. Above and below the breast, what lies in front of the sternal skin is neck,
/// shoulder or abdomen, of which a scan shows as much as its field of view.
double front_left_out(const Work& work, Side side) {
  const Grid& grid = work.scan.grid;
  const int nx = grid.size[0], towards = side == Side::left ? 1 : -1;
  double front = 0, left_out = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    const auto row = work.extent.columns.begin() + std::ptrdiff_t(k) * nx;
    if (std::none_of(row, row + nx, [](auto column) { return column != 0; })) continue;
    for (int i = 0; i < nx; ++i) {
      if ((i - work.torso.midline) * towards <= 0) continue;
      for (int j = 0; j < grid.size[1] && j * grid.spacing[1] < work.torso.cleft[k]; ++j) {
        front += work.body.mask.at(i, j, k);
        left_out += work.body.mask.at(i, j, k) && !work.breast.at(i, j, k);
      }
    }
  }
  return front > 0 ? 100 * left_out / front : 0;
}

}  // namespace

Extents extents_of(const Work& work, const Vec3& nipple, Side side) {
  const Grid& grid = work.scan.grid;
  Extents found;
  double breast = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double aside =
          (i - work.torso.midline) * grid.spacing[0] * (side == Side::left ? 1 : -1);
      if (work.extent.columns[std::size_t(k) * grid.size[0] + i])
        found.lateral_border_mm = std::max(found.lateral_border_mm, aside);
      for (int j = 0; j < grid.size[1]; ++j) breast += work.breast.at(i, j, k);
    }
  }
  found.front_left_out_percent = front_left_out(work, side);
  found.view_behind_sternum_mm = view_behind_sternum(work);
  found.volume_ml = breast * grid.voxel_volume() / mm3_per_ml;
  const Vec3 at = grid.to_index(nipple);
  const int i = std::clamp(int(std::lround(at[0])), 0, grid.size[0] - 1),
            k = std::clamp(int(std::lround(at[2])), 0, grid.size[2] - 1);
  found.nipple_depth_mm = work.wall.depth.at(i, k) - at[1] * grid.spacing[1];
  found.nipple_in_front_mm = work.torso.cleft[k] - at[1] * grid.spacing[1];
  return found;
}

std::vector<std::string> extent_doubts(const Extents& found, double greatest_depth_mm) {
  constexpr double most_left_out = 12;                         // %
  constexpr double least_volume = 50, most_volume = 3500;      // ml
  constexpr double least_border = 70, most_border = 230;       // mm
  constexpr double least_depth = 15, least_share_depth = 0.6;  // mm, of the greatest depth
  constexpr double least_view = 30;  // mm: 37 and more on whole breasts, 24 and less on cut ones
  std::vector<std::string> doubts;
  const auto outside = [](double value, double least, double most) {
    return !(value >= least && value <= most);
  };
  if (!(found.front_left_out_percent < most_left_out)) {
    doubts.push_back(message("extent doubtful: ", std::lround(found.front_left_out_percent),
                             " % of the body in front of the skin over the sternum is not "
                             "labelled breast (usually below ",
                             std::lround(most_left_out), " %): see --overlay"));
  }
  if (found.view_behind_sternum_mm < least_view) {
    doubts.push_back(message(
        "extent doubtful: the field of view ends ", std::lround(found.view_behind_sternum_mm),
        " mm behind the skin over the sternum (usually at least ", least_view,
        "), where it may cut the breast at its side: volume and wall are those "
        "of the visible part; see --overlay"));
  }
  if (outside(found.volume_ml, least_volume, most_volume)) {
    doubts.push_back(message("extent doubtful: a breast of ", std::lround(found.volume_ml), " ml (",
                             least_volume, "-", most_volume, " expected): look at --overlay"));
  }
  if (outside(found.lateral_border_mm, least_border, most_border)) {
    doubts.push_back(message("extent doubtful: its lateral border lies ",
                             std::lround(found.lateral_border_mm), " mm from the midline (",
                             least_border, "-", most_border, " expected): look at --overlay"));
  }
  if (!(found.nipple_depth_mm > std::max(least_depth, least_share_depth * greatest_depth_mm))) {
    doubts.push_back(message("extent doubtful: the nipple lies ",
                             std::lround(found.nipple_depth_mm),
                             " mm in front of the chest wall, the breast is ",
                             std::lround(greatest_depth_mm), " mm deep: look at --overlay"));
  }
  return doubts;
}

}  // namespace breast
