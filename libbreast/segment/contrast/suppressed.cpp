// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast/suppressed.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "segment/bias_and_wall.hpp"
#include "segment/contrast/suppressed_level.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/itk_filters.hpp"

namespace breast {

namespace {

constexpr float whole_fat = 1000;  // its brightness, as it is shown
constexpr double before_wall = 2;  // mm in front of the wall
// A scale over less than this would turn noise of fat into tissue.
constexpr double least_water = 1.15;

/// Depth (mm) per column up to which there may be fat: the wall, or before it is known what lies
/// little behind the sternal skin, where there is no lung, which can be as dark as suppressed fat.
double fat_limit(const Work& work, int i, int k) {
  constexpr double behind_sternum = 8;
  const bool known = work.wall.depth.nx > 0 && !std::isnan(work.wall.depth.at(i, k));
  return known ? work.wall.depth.at(i, k) - before_wall : work.torso.cleft[k] + behind_sternum;
}

/// One within a mask, 0 outside.
Volume<float> as_share(const Mask& mask) {
  Volume<float> share(mask.grid);
  share.voxels.assign(mask.voxels.begin(), mask.voxels.end());
  return share;
}

/// Within `reach` mm of a mask.
Mask wider(const Mask& mask, double reach) {
  const Volume<float> value = box_maximum(as_share(mask), reach);
  Mask out(mask.grid);
  for (std::size_t n = 0; n < out.voxels.size(); ++n) out.voxels[n] = value.voxels[n] > 0;
  return out;
}

constexpr double by_failed = 10;  // mm: within this distance, suppression recovers

/// If more than this share of the tissue below the skin lies near failed suppression, no level of
/// suppressed fat is left to be found.
constexpr double most_near_failed = 0.8;

/// Log level of suppressed fat on the working grid. Near fat that is not suppressed (`fat.failed`, may be
/// empty) there is none, and what is darkest there, muscle or gland, must not be taken for it: the level is
/// continued from around, if enough is left. Sets `fat.near_failed`.
Volume<float> level_of(const Work& work, const Volume<float>& scan, SuppressedFat& fat) {
  const Volume<float> coarse = coarsened(scan, {2, 2, 1});
  const Volume<float> distance = resampled(work.skin_distance, coarse.grid);
  const Grid& grid = coarse.grid;
  Volume<float> beside(grid);
  if (!fat.failed.voxels.empty()) beside = resampled(as_share(wider(fat.failed, by_failed)), grid);
  Mask anywhere(grid), clear(grid);
  double tissue = 0, near = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double limit = fat_limit(work, std::min(2 * i, scan.grid.size[0] - 1), k);
      for (int j = 0; j < grid.size[1]; ++j) {
        if (!(distance.at(i, j, k) < 0 && (2 * j + 0.5) * scan.grid.spacing[1] < limit)) continue;
        anywhere.at(i, j, k) = 1;
        clear.at(i, j, k) = !(beside.at(i, j, k) > 0.5f);
        tissue += 1;
        near += !clear.at(i, j, k);
      }
    }
  }
  const double share = near / std::max(1.0, tissue);
  fat.near_failed = std::max(fat.near_failed, share);  // a level from beside it may hide it later
  const Mask& allowed = share > most_near_failed ? anywhere : clear;
  return resampled(suppressed_level(coarse, allowed, distance).log_bias, scan.grid);
}

Volume<float> relative_to(const Volume<float>& log_level, Volume<float> scan) {
  for (std::size_t n = 0; n < scan.voxels.size(); ++n)
    scan.voxels[n] /= elementary::exp(log_level.voxels[n]);
  return scan;
}

/// Brightness of the skin that lies in front of the sternum: for each point of the surface the brightest voxel within 3 mm,
/// and of these the median.
double brightness_of_skin(const Work& work, const Volume<float>& relative) {
  constexpr double outer = 3;  // mm
  Volume<float> shell(relative.grid);
  for (std::size_t n = 0; n < shell.voxels.size(); ++n)
    if (-work.skin_distance.voxels[n] > -outer && -work.skin_distance.voxels[n] < outer)
      shell.voxels[n] = relative.voxels[n];
  const Volume<float> brightest = box_maximum(shell, outer);
  std::vector<float> values;
  const Grid& grid = relative.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j * grid.spacing[1] < work.torso.cleft[k] && j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double depth = -work.skin_distance.at(i, j, k);
        if (depth > 0 && depth < grid.spacing[0]) values.push_back(brightest.at(i, j, k));
      }
    }
  }
  return median(std::move(values), 1);
}

/// Of the brightness of muscle: gland has 1.3 times that, and fat that is not suppressed 3 times.
constexpr double beyond_water = 2.1;

/// Where fat is surely not suppressed: far brighter than tissue that holds `water`.
Mask far_brighter(const Work& work, const Volume<float>& relative, double water) {
  const Grid& grid = relative.grid;
  Mask bright(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double limit = fat_limit(work, i, k);
      for (int j = 0; j < grid.size[1] && j * grid.spacing[1] < limit; ++j)
        bright.at(i, j, k) =
            work.body.mask.at(i, j, k) && relative.at(i, j, k) > beyond_water * water;
    }
  }
  return bright;
}

/// Sets where fat is not suppressed: what hangs together brighter than gland, is larger than a
/// lesion or a vessel, and reaches the fat below the skin.
void find_failed(SuppressedFat& fat, const Work& work, const Volume<float>& relative,
                 double water) {
  constexpr double beyond_gland = 1.5, thick = 4, least_ml = 10, below_skin = 10;  // mm
  const Mask sure = far_brighter(work, relative, water);
  fat.failed = Mask(relative.grid);
  fat.failed_brightness = 1;
  fat.failed_ml = 0;
  if (std::none_of(sure.voxels.begin(), sure.voxels.end(), [](auto v) { return v; })) return;
  Mask bright(relative.grid);
  for (std::size_t n = 0; n < bright.voxels.size(); ++n)
    bright.voxels[n] = work.body.mask.voxels[n] && relative.voxels[n] > beyond_gland * water;
  const Volume<float> depth = signed_distance(sure);
  const Components parts = components(bright);
  struct Part {
    double sure_ml = 0;
    bool thick = false, at_skin = false;
    bool failed() const { return sure_ml > least_ml && thick && at_skin; }
  };
  std::vector<Part> all(parts.count + 1);
  for (std::size_t n = 0; n < bright.voxels.size(); ++n) {
    Part& part = all[parts.label[n]];
    part.sure_ml += sure.voxels[n] * relative.grid.voxel_volume() / mm3_per_ml;
    part.thick = part.thick || depth.voxels[n] < -thick;
    part.at_skin = part.at_skin || (sure.voxels[n] && -work.skin_distance.voxels[n] < below_skin);
  }
  std::vector<float> values;
  for (std::size_t n = 0; n < bright.voxels.size(); ++n) {
    if (!bright.voxels[n] || !all[parts.label[n]].failed()) continue;
    fat.failed.voxels[n] = 1;
    fat.failed_ml += sure.voxels[n] * relative.grid.voxel_volume() / mm3_per_ml;
    if (depth.voxels[n] < -thick) values.push_back(relative.voxels[n]);
  }
  fat.failed_brightness = median(std::move(values), 1);
}

/// As a scan with bright fat would show it: fat 1, tissue `water` times as bright as suppressed fat
/// `dark`, and mixtures between. Near `failed` suppression, what is brighter than water is a
/// mixture with fat, too.
struct Shown {
  double water, dark, failed_fat;
  float operator()(double relative, bool near_failed) const {
    constexpr double least = 0.1, most = 1.3, darkest_fat = 0.3;
    if (relative < darkest_fat) return float(dark);  // lung, or what holds no signal
    const double share = (relative - 1) / (water - 1);
    if (near_failed && relative > water) {
      const double back = (relative - water) / std::max(failed_fat - water, 1e-6);
      return float(std::clamp(dark + (1 - dark) * back, dark, most));
    }
    return float(std::clamp(1 - (1 - dark) * share, least, most));
  }
};

Mask resampled_mask(const Mask& coarse, const Grid& fine) {
  const Volume<float> share = resampled(as_share(coarse), fine);
  Mask out(fine);
  for (std::size_t n = 0; n < out.voxels.size(); ++n) out.voxels[n] = share.voxels[n] > 0.5f;
  return out;
}

/// Change per mm of a volume at a voxel off its border.
Vec3 slope_at(const Volume<float>& volume, int i, int j, int k) {
  const Vec3& spacing = volume.grid.spacing;
  return Vec3(volume.at(i + 1, j, k) - volume.at(i - 1, j, k),
              volume.at(i, j + 1, k) - volume.at(i, j - 1, k),
              volume.at(i, j, k + 1) - volume.at(i, j, k - 1))
      .cwiseQuotient(2 * spacing);
}

/// Where suppression fades, fat has any brightness, that of gland as well. Such fat brightens steadily towards where it
/// is not suppressed; gland and muscle do not.
Mask fading(const Volume<float>& relative, const Volume<float>& skin_distance, const Mask& failed,
            const Mask& near_failed) {
  constexpr double skin = 4, smooth = 1.5, wide = 8;  // mm
  constexpr double steady = 0.12;                     // of the logarithm, per mm
  constexpr double edge = 0.02;  // per mm, of the share of failed suppression: 0.05 at its edge
  constexpr double least_cosine = 0.7;
  const Volume<float> share = gaussian(as_share(failed), wide);
  Volume<float> logs = gaussian(relative, smooth);
  for (float& value : logs.voxels) value = elementary::log(std::max(value, 0.1f));
  const Grid& grid = relative.grid;
  Mask fat(grid);
  for (int k = 1; k + 1 < grid.size[2]; ++k) {
    for (int j = 1; j + 1 < grid.size[1]; ++j) {
      for (int i = 1; i + 1 < grid.size[0]; ++i) {
        if (!near_failed.at(i, j, k) || skin_distance.at(i, j, k) > -skin) continue;
        const Vec3 towards = slope_at(share, i, j, k), brighter = slope_at(logs, i, j, k);
        const double along = towards.dot(brighter) / std::max(towards.norm(), 1e-9);
        fat.at(i, j, k) =
            towards.norm() > edge && along > steady && along > least_cosine * brighter.norm();
      }
    }
  }
  return fat;
}

/// Everything shown as that, 0 in air.
Volume<float> shown(const Volume<float>& relative, const Volume<float>& skin_distance,
                    const Mask& failed, const Shown& as) {
  constexpr double by_skin = 3;  // mm
  const bool any = as.failed_fat > 1;
  const Mask near = any ? wider(failed, by_failed) : failed,
             between = any ? fading(relative, skin_distance, failed, near) : failed;
  Volume<float> out(relative.grid);
  for (std::size_t n = 0; n < out.voxels.size(); ++n) {
    const float r = relative.voxels[n], d = skin_distance.voxels[n];
    if (d > by_skin) continue;
    out.voxels[n] = whole_fat * (between.voxels[n] && d < 0 ? 1 : as(r, near.voxels[n]));
    if (d > -by_skin) out.voxels[n] *= std::clamp(2 * r, 0.0f, 1.0f);
  }
  return out;
}

/// Calls `visit(i, k, depth behind the wall, brightness)` within 10 mm of the wall.
template <class Visit>
void beside_wall(const Work& work, const Volume<float>& relative, const Visit& visit) {
  constexpr double reach = 10;  // mm
  const double step = relative.grid.spacing[1];
  for (int k = 0; k < work.wall.depth.nz; ++k) {
    for (int i = work.domain.first; i <= work.domain.last; ++i) {
      const double depth = work.wall.depth.at(i, k);
      if (std::isnan(depth) || std::isnan(work.domain.skin.at(i, k))) continue;
      const int last = std::min(int((depth + reach) / step), relative.grid.size[1] - 1);
      for (int j = std::max(0, int((depth - reach) / step)); j <= last; ++j)
        visit(i, k, j * step - depth, std::size_t(relative.grid.offset(i, j, k)));
    }
  }
}

/// Median brightness 2-8 mm behind the wall.
double water_behind(const Work& work, const Volume<float>& relative) {
  std::vector<float> values;
  beside_wall(work, relative, [&](int, int, double behind, std::size_t n) {
    if (behind > 2 && behind < 8) values.push_back(relative.voxels[n]);
  });
  return std::max(least_water, median(std::move(values), least_water));
}

MuscleOverFat muscle_over_fat(const Work& work, const Volume<float>& relative, const Mask& failed) {
  constexpr double patch = 25;  // mm
  constexpr std::size_t enough = 60;
  constexpr float fat_low = 0.6f, fat_high = 1.4f;
  const int across = std::max(1, int(patch / work.scan.grid.spacing[0])),
            along = std::max(1, int(patch / work.scan.grid.spacing[2]));
  const int columns = work.scan.grid.size[0] / across + 1;
  const std::size_t count = std::size_t(columns) * (work.scan.grid.size[2] / along + 1);
  std::vector<std::vector<float>> muscle(count), fat(count);
  beside_wall(work, relative, [&](int i, int k, double behind, std::size_t n) {
    const std::size_t at = std::size_t(k / along) * columns + i / across;
    const float r = relative.voxels[n];
    if (failed.voxels[n]) return;
    if (behind > 2 && behind < 8) muscle[at].push_back(r);
    if (behind < -2 && r > fat_low && r < fat_high) fat[at].push_back(r);
  });
  std::vector<double> ratios;
  for (std::size_t n = 0; n < count; ++n) {
    if (muscle[n].size() < enough || fat[n].size() < enough) continue;
    ratios.push_back(median(std::move(muscle[n]), 0) / median(std::move(fat[n]), 1));
  }
  MuscleOverFat found;
  found.low = percentile(ratios, 0.05, 0);
  found.median = percentile(std::move(ratios), 0.5, 0);
  return found;
}

constexpr double darkest_skin = 1.05;  // of suppressed fat

/// The wall's level of muscle, in the scan that is shown.
constexpr double muscle_as_in_t1 = 0.3, gland_as_in_t1 = 0.45;

}  // namespace

bool may_be_suppressed(const FatContrast& contrast) {
  return !(contrast.skin_to_subcutis > 0) || contrast.skin_to_subcutis > darkest_skin;
}

std::string refusal_of_skin(const FatContrast& contrast) {
  return message("the skin, which holds water, is ", format_fixed(contrast.skin_to_subcutis, 2),
                 " times as bright as the tissue below it (at least ", darkest_skin,
                 " where suppressed fat is told from water)");
}

namespace {

/// Sets the level of fat and where it is not suppressed. Returns the scan relative to that level.
Volume<float> find_level(SuppressedFat& fat, const Work& work, const Volume<float>& scan) {
  const bool wall_known = work.wall.depth.nx > 0;
  const auto once = [&] {
    fat.log_level = level_of(work, scan, fat);
    Volume<float> relative = relative_to(fat.log_level, scan);
    // Until a wall is known, muscle is assumed to be only a little brighter than fat, because a larger
    // value would hide it, and the brightness of tissue that holds water is measured on the skin.
    const double water =
        wall_known ? water_behind(work, relative) : brightness_of_skin(work, relative);
    if (wall_known) fat.water = water;
    find_failed(fat, work, relative, water);
    return relative;
  };
  Volume<float> relative = once();
  // The first level was sought beside failed suppression, too.
  return wall_known || !(fat.failed_ml > 0) ? relative : once();
}

}  // namespace

SuppressedFat find_suppressed_wall(Work& work, Progress& progress, Timer& timer) {
  constexpr int rounds = 3;
  const Volume<float> scan = work.scan;
  SuppressedFat fat;
  work.wall = {};
  for (int round = 0; round < rounds; ++round) {
    const Volume<float> relative = find_level(fat, work, scan);
    work.scan = shown(relative, work.skin_distance, fat.failed,
                      {fat.water, muscle_as_in_t1, fat.failed_brightness});
    work.wall = {};
    work.bias = {};
    find_wall(work, progress, timer);
    fat.muscle = muscle_over_fat(work, relative, fat.failed);
  }
  return fat;
}

namespace {

/// Brightness of gland in front of the wall: of the brighter end, since fat is mixed with it.
double brightness_of_gland(const Work& work, const Volume<float>& relative, const Mask& near_failed,
                           double muscle) {
  constexpr double skin = 4, bright_end = 0.97;  // mm
  std::vector<float> values;
  const Grid& grid = relative.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = work.domain.first; i <= work.domain.last; ++i) {
      const double limit = fat_limit(work, i, k);
      for (int j = 0; j < grid.size[1] && j * grid.spacing[1] < limit; ++j)
        if (-work.skin_distance.at(i, j, k) > skin && !near_failed.at(i, j, k))
          values.push_back(relative.at(i, j, k));
    }
  }
  return std::max(muscle, percentile(std::move(values), bright_end, muscle));
}

/// A scan on any grid as one in which fat is bright, for the separation of gland from fat.
Volume<float> shown_for_gland(const Volume<float>& scan, const Work& work, const SuppressedFat& fat,
                              const Shown& as) {
  const Grid& grid = scan.grid;
  const Volume<float> relative = relative_to(resampled(fat.log_level, grid), scan),
                      distance = resampled(work.skin_distance, grid);
  return shown(relative, distance, resampled_mask(fat.failed, grid), as);
}

}  // namespace

void show_gland(Work& work, const Volume<float>& scan, Images& images, SuppressedFat& fat) {
  fat.log_level = level_of(work, scan, fat);
  const Volume<float> relative = relative_to(fat.log_level, scan);
  find_failed(fat, work, relative, fat.water);
  fat.gland = brightness_of_gland(work, relative, wider(fat.failed, by_failed), fat.water);
  const Shown as{fat.gland, gland_as_in_t1, fat.failed_brightness};
  work.scan = shown_for_gland(scan, work, fat, as);
  // Speckle was judged by what is bright, and little is bright where fat is suppressed.
  images.speckled = false;
  images.outline = std::move(images.tissue);
  images.tissue = shown_for_gland(images.outline, work, fat, as);
  work.wall.muscle_ratio =
      std::clamp(1 - (1 - gland_as_in_t1) * (fat.muscle.median - 1) / (as.water - 1), 0.2, 0.75);
}

namespace {

constexpr double least_over_fat = 1.2, most_over_fat = 4.5;

std::string refusal_of_muscle(const MuscleOverFat& muscle) {
  constexpr double least_in_patches = 1.0;
  if (muscle.median > most_over_fat)
    return message("muscle is ", format_fixed(muscle.median, 1), " times as bright as fat (",
                   least_over_fat, " to ", most_over_fat,
                   " where fat is suppressed), as in the water image of a Dixon scan alone");
  if (muscle.median >= least_over_fat && muscle.low >= least_in_patches) return "";
  return message("muscle is ", format_fixed(muscle.median, 2), " times as bright as fat (at least ",
                 least_over_fat, " needed to see the chest wall), ", format_fixed(muscle.low, 2),
                 " in the twentieth of places where least (at least ", least_in_patches, ")");
}

}  // namespace

DarkFat dark_fat(const SuppressedFat& fat) {
  if (fat.muscle.median > most_over_fat) return DarkFat::silent;
  const bool measured = fat.muscle.median >= least_over_fat && fat.near_failed <= most_near_failed;
  return measured ? DarkFat::suppressed : DarkFat::unknown;
}

std::string refusal_of(const SuppressedFat& fat) {
  const std::string muscle = refusal_of_muscle(fat.muscle);
  if (!muscle.empty()) return muscle;
  if (fat.near_failed > most_near_failed)
    return message("tissue as bright as fat that is not suppressed lies beside ",
                   std::lround(100 * fat.near_failed), " % of the tissue below the skin (at most ",
                   std::lround(100 * most_near_failed),
                   " %), so that the brightness of suppressed fat is unknown");
  // At 2, walls of known anatomies are as right as without failure, and at 1.4 none is accepted.
  constexpr double least_beside_failed = 1.7;
  if (fat.failed_ml > 0 && fat.muscle.median < least_beside_failed)
    return message("fat is not suppressed in ", std::lround(fat.failed_ml),
                   " ml, and elsewhere muscle is ", format_fixed(fat.muscle.median, 2),
                   " times as bright as fat (at least ", least_beside_failed,
                   " needed to see the chest wall then)");
  if (!(fat.gland > beyond_water * fat.water)) return "";
  return message("3 % of the breast are more than ", format_fixed(fat.gland / fat.water, 1),
                 " times as bright as muscle (at most ", beyond_water,
                 " if they are gland): fat is not suppressed there");
}

void doubt_wall_by_failed(Work& work, const SuppressedFat& fat) {
  constexpr double sigma = 6;  // mm: of the walls of known anatomies beside failed suppression
  constexpr double most_confidence = 0.4;
  if (!(fat.failed_ml > 0)) return;
  const Volume<float> distance = signed_distance(fat.failed);
  const Grid& grid = distance.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = work.domain.first; i <= work.domain.last; ++i) {
      const double depth = work.wall.depth.at(i, k);
      if (std::isnan(depth)) continue;
      const int j = std::clamp(int(std::lround(depth / grid.spacing[1])), 0, grid.size[1] - 1);
      if (distance.at(i, j, k) > by_failed) continue;
      double& sure = work.wall.confidence.at(i, k);
      sure = std::min(sure, most_confidence);
      work.wall.sigma.at(i, k) = std::hypot(work.wall.sigma.at(i, k), sigma);
    }
  }
}

std::string doubt_of_failed(const SuppressedFat& fat) {
  if (!(fat.failed_ml > 0)) return "";
  const Grid& grid = fat.failed.grid;
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!fat.failed.at(i, j, k)) continue;
        const Vec3 at = grid.to_patient(Vec3(i, j, k));
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
      }
    }
  }
  const auto from_to = [&](int d) {
    return message(std::lround(low[d]), " to ", std::lround(high[d]));
  };
  return message("fat is not suppressed in ", std::lround(fat.failed_ml), " ml (x ", from_to(0),
                 ", y ", from_to(1), ", z ", from_to(2),
                 " mm): the chest wall beside it is uncertain, and fat may be taken for gland or "
                 "gland for fat there; check both (--overlay)");
}

}  // namespace breast
