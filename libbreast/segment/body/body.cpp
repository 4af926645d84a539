// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/body/body.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/units.hpp"
#include "segment/body/debris.hpp"
#include "segment/body/slices.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/grid/noise.hpp"
#include "segment/grid/otsu.hpp"

namespace breast {

namespace {

/// Otsu's threshold of values in a histogram of 256 classes.
double threshold_of_values(const std::vector<float>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double first = *low, width = (*high - *low) / 256.0;
  std::vector<double> count(256);
  for (const float v : values) count[std::min(255, int((v - first) / width))] += 1;
  return first + width * otsu_class(count, 0);
}

/// Closes gaps, then fills everything air cannot reach from the front.
void close_and_fill(Mask& mask) {
  close_slices(mask, 2.5);
  fill_slices_from_front(mask);
}

/// Lungs may open to the scan's side where the field of view cuts the body: air with body in front
/// of it in its column, deeper than `from` mm behind the sternal skin, is body when there is body
/// (or the cut end of the body) behind it too.
void fill_chest(Mask& mask, const TorsoFront& torso, double from) {
  const auto& size = mask.grid.size;
  std::size_t on_last_row = 0;
  for (int k = 0; k < size[2]; ++k) {
    for (int i = 0; i < size[0]; ++i) on_last_row += mask.at(i, size[1] - 1, k);
  }
  const bool cut = on_last_row > std::size_t(size[0]) * size[2] / 10;
  for (int k = 0; k < size[2]; ++k) {
    const int start = int((torso.cleft[k] + from) / mask.grid.spacing[1]);
    for (int i = 0; i < size[0]; ++i) {
      int last = cut ? size[1] - 1 : -1, first = 0;
      while (first < size[1] && !mask.at(i, first, k)) ++first;
      for (int j = size[1] - 1; j > last; --j) {
        if (mask.at(i, j, k)) last = j;
      }
      for (int j = std::max(first, start); j <= last; ++j) mask.at(i, j, k) = 1;
    }
  }
}

/// The torso widens from the sternum to half its depth: behind `torso_start` mm of the
/// sternal skin, down to `least_torso`, whatever lies between its sides in this row or
/// one in front is body. Muscle and lung that the threshold took for air, open to the
/// scan's back or side, come back.
void fill_between_sides(Mask& mask, const TorsoFront& torso) {
  constexpr double torso_start = 30, least_torso = 90;  // mm; the wall is sought to 85
  const Grid& grid = mask.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    const int start = int((torso.cleft[k] + torso_start) / grid.spacing[1]);
    const int end =
        std::min(grid.size[1], int((torso.cleft[k] + least_torso) / grid.spacing[1]) + 1);
    int low = grid.size[0], high = -1;
    for (int j = std::max(start, 0); j < end; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!mask.at(i, j, k)) continue;
        low = std::min(low, i);
        high = std::max(high, i);
      }
      for (int i = low; i <= high; ++i) mask.at(i, j, k) = 1;
    }
    for (int i = 0; i < grid.size[0] && start < end; ++i) {
      const int sternal = std::max(0, int(torso.cleft[k] / grid.spacing[1]));
      int j = start;
      while (j > sternal && !mask.at(i, j - 1, k)) --j;
      if (!mask.at(i, start, k) || j == sternal) continue;
      for (; j < start; ++j) mask.at(i, j, k) = 1;
    }
  }
}

/// Peels boundary voxels that hold less than half of the tissue just inside them, so that the
/// mask's border lies at half height whatever the local coil sensitivity.
void peel_partial_voxels(Mask& mask, const Volume<float>& scan) {
  const Mask before = mask;
  const auto& size = mask.grid.size;
#pragma omp parallel for
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 1; j + 1 < size[1]; ++j) {
      for (int i = 1; i + 1 < size[0]; ++i) {
        if (!before.at(i, j, k)) continue;
        const bool border = !before.at(i - 1, j, k) || !before.at(i + 1, j, k) ||
                            !before.at(i, j - 1, k) || !before.at(i, j + 1, k);
        if (!border) continue;
        std::array<float, 49> inside;
        int count = 0;
        for (int b = std::max(j - 3, 0); b <= std::min(j + 3, size[1] - 1); ++b) {
          for (int a = std::max(i - 3, 0); a <= std::min(i + 3, size[0] - 1); ++a) {
            if (before.at(a, b, k)) inside[count++] = scan.at(a, b, k);
          }
        }
        std::nth_element(inside.begin(), inside.begin() + count / 2, inside.begin() + count);
        if (scan.at(i, j, k) < 0.5f * inside[count / 2]) mask.at(i, j, k) = 0;
      }
    }
  }
}

}  // namespace

namespace {

/// Share of the columns within 100 mm of the midline that are body 20, 40 or 60 mm behind the
/// sternal skin, whichever are fewest. Less than three quarters means that dim tissue was taken for
/// air and only a shell of the chest was found.
double chest_filled(const Mask& mask, const TorsoFront& torso) {
  const Grid& grid = mask.grid;
  const int reach = int(100 / grid.spacing[0]);
  double least = 1;
  for (const double behind : {20.0, 40.0, 60.0}) {
    double filled = 0, count = 0;
    for (int k = 0; k < grid.size[2]; ++k) {
      const int j = std::min(grid.size[1] - 1, int((torso.cleft[k] + behind) / grid.spacing[1]));
      for (int i = std::max(0, torso.midline - reach);
           i <= std::min(grid.size[0] - 1, torso.midline + reach); ++i) {
        filled += mask.at(i, j, k);
        count += 1;
      }
    }
    if (count > 0) least = std::min(least, filled / count);
  }
  return least;
}

struct Found {
  Mask mask;
  double debris_ml = 0, beside_ml = 0;
  double filled = 0;  ///< as chest_filled()
};

/// The largest part that hangs together apart from the body, ml.
double second_component_ml(const Mask& mask) {
  std::vector<std::size_t> count = sizes(components(mask));
  if (count.size() < 3) return 0;  // number 0 is no component
  std::nth_element(count.begin(), count.begin() + 1, count.end(), std::greater<>());
  return double(count[1]) * mask.grid.voxel_volume() / mm3_per_ml;
}

/// Mask of what is brighter than the threshold: opened, filled, its border at half height, debris
/// off. `from` as in fill_chest().
Found body_above(const Volume<float>& scan, double threshold, double from, Side side,
                 Posture posture) {
  Found found;
  Mask& mask = found.mask;
  mask = Mask(scan.grid);
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) mask.voxels[n] = scan.voxels[n] > threshold;
  open_slices(mask, 1.5);
  found.beside_ml = second_component_ml(mask);
  mask = largest_component(mask);
  close_and_fill(mask);
  remove_haze(mask, scan);
  remove_ghosts(mask, scan);
  mask = largest_component(mask);
  const TorsoFront torso = find_torso(mask, side);
  fill_chest(mask, torso, from);
  found.filled = chest_filled(mask, torso);
  fill_between_sides(mask, torso);
  peel_partial_voxels(mask, scan);
  mask = largest_component(mask);
  if (posture == Posture::prone)
    found.debris_ml = remove_debris(mask, find_torso(mask, side).midline);
  if (found.debris_ml > 0) mask = largest_component(mask);
  return found;
}

}  // namespace

Body find_body(const Volume<float>& scan, Side side, Posture posture) {
  Body body;
  body.air_level = corner_air_level(scan);
  const auto [low, high] = std::minmax_element(scan.voxels.begin(), scan.voxels.end());
  if (!(*high > *low)) throw input_error("the scan is uniform (", *low, "): it shows no body");
  if (!(*high > 0)) {
    throw input_error("no voxel of the scan is brighter than 0 (brightest ", *high,
                      "): was a value subtracted, for example by a rescale intercept?");
  }
  // A scan without air noise (n0 = 0) still needs a finite logarithm.
  const double floor = std::max(body.air_level, 1e-3 * double(*high));
  std::vector<float> logs(scan.voxels.size());
  for (std::size_t n = 0; n < logs.size(); ++n) {
    logs[n] = elementary::log(std::max(scan.voxels[n], 0.0f) + float(floor));
  }
  const double otsu_level = elementary::exp(threshold_of_values(logs)) - floor;
  const double count = double(std::count_if(scan.voxels.begin(), scan.voxels.end(),
                                            [&](float v) { return v > otsu_level; }));
  const double fraction = count / double(logs.size());
  if (!(fraction > 0.02 && fraction < 0.95)) {
    throw input_error("the body fills ", 100 * fraction,
                      " % of the scan (2-95 % expected): is this a ",
                      "breast MR with air in front?");
  }
  // Under strong bias and noise Otsu's level may part bright from dim tissue instead of air from
  // body; air itself ends at about twice its 90th percentile.
  const double air_end = std::min(otsu_level, 2 * floor);
  struct Try {
    double level, from;
  };
  double most_filled = -1;
  for (const Try& attempt : {Try{otsu_level, 30}, Try{otsu_level, 12},
                             Try{std::sqrt(otsu_level * air_end), 12}, Try{air_end, 12}}) {
    Found found = body_above(scan, attempt.level, attempt.from, side, posture);
    if (!(found.filled > most_filled)) continue;
    most_filled = found.filled;
    body.threshold = attempt.level;
    body.mask = std::move(found.mask);
    body.debris_ml = found.debris_ml;
    body.beside_ml = found.beside_ml;
    if (most_filled > 0.75) break;
  }
  return body;
}

}  // namespace breast
