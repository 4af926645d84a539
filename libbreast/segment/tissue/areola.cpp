// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/areola.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/statistics/percentile.hpp"
#include "segment/grid/filters.hpp"
#include "segment/tissue/skin_patch.hpp"

namespace breast {

namespace {

constexpr double skin_depth = 5;    // mm: an areola's skin has up to about as much
constexpr double mean_width = 9;    // mm: the standard deviation of a disc of 36 mm across
constexpr double front_reach = 60;  // mm: papillae stand up to 26 mm from the most anterior point
// Areolae are up to 50 mm across: from there on nothing of them is in a mean.
constexpr double beyond_areola = 25 + mean_width;
// On thirteen of fourteen real breasts the thickest skin exceeds the median by 0.63 mm or more, and
// skin away from it by 0.44 mm or less, at most half as much. On the other one both are alike.
constexpr double least_excess = 0.5, most_elsewhere = 0.6;
// Slices of 5 mm thicken skin that faces along the body by more than an areola differs from it.
constexpr double thickest_voxel = 3.001;  // mm
// Gland has 0.3 to 0.6 of the brightness of fat: below this, gland is most of what lies behind.
constexpr double least_behind = 0.7;

struct Profile {
  double missing = -1;  ///< brightness in the skin's depth, mm of fat; negative without an edge
  double behind = 0;    ///< mean brightness in as much depth behind that
};
/// A skin voxel: its place (mm from the box's first voxel, along its axes), its outward normal, the
/// area of its surface and the brightness behind it.
struct SkinSample {
  Vec3 place, out;
  double area;
  Profile profile;
};

/// The voxels within `reach` of a place along each axis, mm.
VoxelBox box_around(const Grid& grid, const Vec3& patient, double reach) {
  const Vec3 at = grid.to_index(patient);
  VoxelBox box;
  for (int d = 0; d < 3; ++d) {
    const double half = reach / grid.spacing[d];
    box.first[d] = std::clamp(int(std::ceil(at[d] - half)), 0, grid.size[d] - 1);
    box.last[d] = std::clamp(int(std::floor(at[d] + half)), box.first[d], grid.size[d] - 1);
  }
  return box;
}

/// Area vector (outward, grid axes) of a voxel's faces towards air.
Vec3 area_towards_air(const Mask& body, int i, int j, int k) {
  const Grid& grid = body.grid;
  Vec3 area = Vec3::Zero();
  for (const auto& step : face_neighbours) {
    const int a = i + step[0], b = j + step[1], c = k + step[2];
    if (!grid.contains(a, b, c) || body.at(a, b, c)) continue;
    for (int d = 0; d < 3; ++d) area[d] += step[d] * grid.voxel_volume() / grid.spacing[d];
  }
  return area;
}

/// Direction in which the distance from the body grows; zero at the border of the grid.
Vec3 outward_normal(const Volume<float>& distance, int i, int j, int k) {
  const std::array<int, 3> at{i, j, k};
  Vec3 slope;
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> behind = at, ahead = at;
    --behind[d], ++ahead[d];
    if (behind[d] < 0 || ahead[d] >= distance.grid.size[d]) return Vec3::Zero();
    slope[d] =
        (distance.at(ahead[0], ahead[1], ahead[2]) - distance.at(behind[0], behind[1], behind[2])) /
        (2 * distance.grid.spacing[d]);
  }
  return slope.norm() > 0 ? Vec3(slope.normalized()) : Vec3::Zero();
}

Profile profile_behind_edge(const Volume<float>& brightness, const Vec3& surface,
                            const Vec3& inward) {
  constexpr double edge = 0.25, step = 0.25, outside = 5, inside = 3;  // of fat; mm
  Profile profile;
  double place = -outside;
  const auto at = [&](double s) { return sample_linear(brightness, surface + s * inward, 0); };
  if (!(at(place) < edge)) return profile;
  while (place < inside && at(place) < edge) place += step;
  if (!(place < inside)) return profile;
  profile.missing = 0;
  for (double s = 0.5 * step; s < 2 * skin_depth; s += step) {
    const double here = std::clamp(at(place + s), 0.0, 1.0);
    if (s < skin_depth)
      profile.missing += step * (1 - here);
    else
      profile.behind += step * here / skin_depth;
  }
  return profile;
}

std::vector<SkinSample> skin_samples(const Volume<float>& brightness, const Mask& breast,
                                     const Mask& body, const Volume<float>& skin_distance) {
  const Grid& grid = breast.grid;
  const Volume<float> distance = gaussian(skin_distance, 2.5);
  std::vector<SkinSample> samples;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!breast.at(i, j, k)) continue;
        const Vec3 faces = area_towards_air(body, i, j, k);
        if (faces.isZero()) continue;
        const Vec3 out = outward_normal(distance, i, j, k);
        const double area = faces.dot(out);
        if (!(area > 0)) continue;
        const Profile profile = profile_behind_edge(brightness, grid.to_patient(Vec3(i, j, k)),
                                                    -(grid.direction * out));
        if (profile.missing >= 0)
          samples.push_back({grid.spacing.cwiseProduct(Vec3(i, j, k)), out, area, profile});
      }
    }
  }
  return samples;
}

/// Adds a value at a place, shared among the eight voxels around it.
void add_at(Volume<float>& volume, const Vec3& place, double value) {
  const Vec3 at = volume.grid.to_index(place);
  const std::array<int, 3> low{int(std::floor(at[0])), int(std::floor(at[1])),
                               int(std::floor(at[2]))};
  for (int corner = 0; corner < 8; ++corner) {
    std::array<int, 3> voxel = low;
    double share = value;
    for (int d = 0; d < 3; ++d) {
      const double beyond = at[d] - low[d];
      const bool next = corner >> d & 1;
      voxel[d] += next;
      share *= next ? beyond : 1 - beyond;
    }
    if (volume.grid.contains(voxel[0], voxel[1], voxel[2]))
      volume.at(voxel[0], voxel[1], voxel[2]) += float(share);
  }
}

/// Replaces both of each profile by their averages around it. A mean this wide needs no more than
/// voxels of 2 mm whatever the scan has; they lie alike on both sides of `front`.
void average(std::vector<SkinSample>& samples, const Vec3& front, double reach) {
  constexpr double spacing = 2;
  const int half = int(std::ceil(reach / spacing)) + 1;
  Grid grid;
  grid.size = {2 * half + 1, 2 * half + 1, 2 * half + 1};
  grid.spacing = Vec3::Constant(spacing);
  grid.origin = front - Vec3::Constant(half * spacing);
  Volume<float> area(grid), missing(grid), behind(grid);
  for (const SkinSample& sample : samples) {
    add_at(area, sample.place, sample.area);
    add_at(missing, sample.place, sample.area * sample.profile.missing);
    add_at(behind, sample.place, sample.area * sample.profile.behind);
  }
  area = gaussian(area, mean_width);
  missing = gaussian(missing, mean_width);
  behind = gaussian(behind, mean_width);
  for (SkinSample& sample : samples) {
    const double total = sample_linear(area, sample.place, 1);
    sample.profile.missing = sample_linear(missing, sample.place, 0) / total;
    sample.profile.behind = sample_linear(behind, sample.place, 0) / total;
  }
}

/// The skin's place under the centre of the samples whose excess is near the greatest, which a
/// single voxel of a broad maximum does not show.
Vec3 centre_of(const std::vector<SkinSample>& samples, const SkinSample& peak, const Mask& body,
               double median_missing) {
  constexpr double near = 20, share = 0.9, skin = 15;  // mm
  const double foot = share * (peak.profile.missing - median_missing) + median_missing;
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (const SkinSample& sample : samples) {
    if (!(sample.profile.missing > foot && (sample.place - peak.place).norm() < near)) continue;
    const double weight = sample.area * (sample.profile.missing - foot);
    sum += weight * sample.place;
    total += weight;
  }
  const Vec3 centre = total > 0 ? Vec3(sum / total) : peak.place;
  const std::vector<SkinFace> faces = skin_faces(body, centre, skin);
  const TangentFrame frame = tangent_frame(faces, centre);
  return frame.place(0, 0, quadric_through(faces, frame, 0, skin)[0]);
}

}  // namespace

Areola find_areola(const Volume<float>& brightness, const Mask& breast, const Mask& body,
                   const Volume<float>& skin_distance, const Vec3& front) {
  Areola areola;
  if (breast.grid.spacing.maxCoeff() > thickest_voxel) return areola;
  const double reach = front_reach + 3 * mean_width;
  const VoxelBox box = box_around(body.grid, front, reach);
  const Mask near_body = cropped(body, box);
  std::vector<SkinSample> samples =
      skin_samples(brightness, cropped(breast, box), near_body, cropped(skin_distance, box));
  std::erase_if(samples, [](const SkinSample& sample) { return !(sample.out[1] < 0); });
  if (samples.empty()) return areola;
  std::vector<double> all;
  for (const SkinSample& sample : samples) all.push_back(sample.profile.missing);
  const double usual = median(all);
  const Grid& grid = near_body.grid;
  const Vec3 start = grid.spacing.cwiseProduct(grid.to_index(front));
  average(samples, start, reach);
  std::erase_if(samples, [&](const SkinSample& sample) {
    return !((sample.place - start).norm() < front_reach);
  });
  if (samples.empty()) return areola;
  const SkinSample peak =
      *std::max_element(samples.begin(), samples.end(), [](const auto& one, const auto& other) {
        return one.profile.missing < other.profile.missing;
      });
  const Vec3 centre = centre_of(samples, peak, near_body, usual);
  areola.centre = grid.to_patient(centre.cwiseQuotient(grid.spacing));
  areola.excess = peak.profile.missing - usual;
  for (const SkinSample& sample : samples) {
    if ((sample.place - centre).norm() > beyond_areola)
      areola.elsewhere = std::max(areola.elsewhere, sample.profile.missing - usual);
  }
  areola.behind = peak.profile.behind;
  areola.found = areola.excess > least_excess && areola.behind > least_behind &&
                 areola.elsewhere < most_elsewhere * areola.excess;
  return areola;
}

}  // namespace breast
