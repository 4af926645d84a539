#include "segment/segment.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "segment/bias.hpp"
#include "segment/body.hpp"
#include "segment/chest_wall.hpp"
#include "segment/extent.hpp"
#include "segment/filters.hpp"
#include "segment/itk_filters.hpp"
#include "segment/tissue.hpp"
#include "segment/wall_input.hpp"

namespace breast {

namespace {

constexpr double depth_limit =
    45;  // mm behind the sternal skin: no fat for the first bias estimate
constexpr double wall_clearance = 2;  // mm in front of the wall used for the later ones

/// Everything the stages pass on, on the working grid.
struct Work {
  Volume<float> scan, ratio, skin_distance;
  Body body;
  Torso torso;
  WallDomain domain;
  ChestWall wall;
  BiasField bias;
  BreastExtent extent;
  Mask breast;
  Fibroglandular gland;
  double skin = 0;
};

/// Bias on a grid halved in plane, and the ratio on the working grid. `limit` gives the depth (mm)
/// per column up to which there may be fat.
template <class Limit>
void correct_bias(Work& work, const BiasSettings& settings, const Limit& limit) {
  const std::array<int, 3> half{2, 2, 1};
  const Volume<float> coarse = coarsened(work.scan, half);
  Volume<float> distance = resampled(work.skin_distance, coarse.grid);
  Mask allowed(coarse.grid);
  const Grid& grid = coarse.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double depth = limit(std::min(2 * i, work.scan.grid.size[0] - 1), k);
      for (int j = 0; j < grid.size[1]; ++j) {
        allowed.at(i, j, k) =
            distance.at(i, j, k) < 0 && (2 * j + 0.5) * work.scan.grid.spacing[1] < depth;
      }
    }
  }
  work.bias = fat_bias(coarse, allowed, distance, settings);
  const Volume<float> fine = resampled(work.bias.log_bias, work.scan.grid);
  work.ratio = work.scan;
  for (std::size_t n = 0; n < fine.voxels.size(); ++n) {
    work.ratio.voxels[n] =
        work.body.mask.voxels[n] ? work.scan.voxels[n] / std::exp(fine.voxels[n]) : 0;
  }
}

void find_wall(Work& work, const SegmentOptions& options, Progress& progress, Timer& timer) {
  for (int pass = 0; pass < 2; ++pass) {
    progress.update("chest wall", 0.2 + 0.25 * pass, pass ? "second pass" : "first pass");
    {
      const Timer::Scope phase(timer, "bias");
      BiasSettings settings;
      settings.window = pass ? 30 : 50;
      correct_bias(work, settings, [&](int i, int k) {
        const double sternal = work.torso.cleft[k] + depth_limit;
        if (pass == 0 || std::isnan(work.wall.depth.at(i, k))) return sternal;
        return work.wall.depth.at(i, k) - wall_clearance;
      });
    }
    const Timer::Scope phase(timer, "chest_wall");
    work.wall = find_chest_wall(work.ratio, work.domain, pass ? &work.wall : nullptr);
  }
  const Timer::Scope phase(timer, "chest_wall");
  snap_chest_wall(work.wall, work.ratio, work.domain);
  if (options.wall_labels)
    apply_wall_labels(work.wall, work.domain, work.scan.grid, *options.wall_labels);
  if (!options.wall_points.empty()) {
    apply_wall_points(work.wall, work.domain, work.scan.grid, options.wall_points);
  }
}

/// Inside of the breast: beyond the skin, in front of the wall.
Mask interior_of(const Work& work, double skin_depth, double wall_margin) {
  Mask interior = work.breast;
  const Grid& grid = interior.grid;
  const double half_voxel = 0.25 * (grid.spacing[0] + grid.spacing[1]);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!interior.at(i, j, k)) continue;
        const bool skin = -work.skin_distance.at(i, j, k) + half_voxel < skin_depth;
        const bool wall = work.wall.depth.at(i, k) - j * grid.spacing[1] < wall_margin;
        if (skin || wall) interior.at(i, j, k) = 0;
      }
    }
  }
  return interior;
}

LabelVolume label(const Work& work, Side side) {
  LabelVolume labels;
  const Grid& grid = work.scan.grid;
  labels.grid = grid;
  labels.side = side;
  labels.tissue.assign(grid.voxels(), std::uint8_t(Tissue::air));
  labels.fibroglandular_fraction = work.gland.fraction.voxels;
  labels.chest_wall_confidence.assign(grid.voxels(), 0);
  const double half_voxel = 0.25 * (grid.spacing[0] + grid.spacing[1]);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        const double wall = work.wall.depth.at(i, k);
        if (!std::isnan(wall))
          labels.chest_wall_confidence[n] = float(work.wall.confidence.at(i, k));
        if (!work.body.mask.voxels[n]) continue;
        Tissue tissue = Tissue::other;
        if (!std::isnan(wall) && j * grid.spacing[1] >= wall) {
          tissue = Tissue::muscle;
        } else if (work.breast.voxels[n]) {
          // At least the outermost voxel is skin.
          const double depth = -work.skin_distance.voxels[n] + half_voxel;
          tissue = depth < std::max(work.skin, 1.02 * half_voxel) ? Tissue::skin
                   : labels.fibroglandular_fraction[n] > 0.5f     ? Tissue::fibroglandular
                                                                  : Tissue::fat;
        }
        labels.tissue[n] = std::uint8_t(tissue);
        if (tissue != Tissue::fat && tissue != Tissue::fibroglandular)
          labels.fibroglandular_fraction[n] = 0;
      }
    }
  }
  labels.skin_thickness = work.skin;
  return labels;
}

/// Data for surface fitting: skin at voxel faces against air, wall on the breast's columns.
TriMesh data_points(const Work& work) {
  TriMesh points;
  auto& surface = points.point_data["surface"];
  auto& confidence = points.point_data["confidence"];
  const Grid& grid = work.scan.grid;
  const auto add = [&](const Vec3& index, double kind, double sure) {
    points.points.push_back(grid.to_patient(index));
    surface.push_back(kind);
    confidence.push_back(sure);
  };
  constexpr int step[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!work.breast.at(i, j, k)) continue;
        for (const auto& s : step) {
          if (!grid.contains(i + s[0], j + s[1], k + s[2]) ||
              work.body.mask.at(i + s[0], j + s[1], k + s[2]))
            continue;
          add(Vec3(i + 0.5 * s[0], j + 0.5 * s[1], k + 0.5 * s[2]), 0, 1);
        }
      }
    }
  }
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      if (!work.extent.columns[std::size_t(k) * grid.size[0] + i]) continue;
      add(Vec3(i, work.wall.depth.at(i, k) / grid.spacing[1], k), 1, work.wall.confidence.at(i, k));
    }
  }
  return points;
}

void summarise(Segmentation& result, const Work& work) {
  result.midline_mm =
      work.scan.grid.to_patient(Vec3(work.torso.midline, 0, 0.5 * work.scan.grid.size[2]))[0];
  result.muscle_ratio = work.wall.muscle_ratio;
  result.gland_ratio = work.gland.gland_ratio;
  result.fat_fraction = work.gland.fat_fraction;
  result.fat_fraction_grown = work.gland.fat_fraction_grown;
  result.fibroglandular_agreement = work.gland.agreement;
  result.sternal_thickness = work.extent.sternal_thickness;
  result.greatest_thickness = work.extent.greatest_thickness;
  double sum = 0, sure = 0, count = 0;
  for (int k = 0; k < work.wall.depth.nz; ++k) {
    for (int i = 0; i < work.wall.depth.nx; ++i) {
      if (!work.extent.columns[std::size_t(k) * work.wall.depth.nx + i]) continue;
      sum += work.wall.confidence.at(i, k);
      sure += work.wall.confidence.at(i, k) > 0.5;
      count += 1;
    }
  }
  result.wall_confidence_mean = count > 0 ? sum / count : 0;
  result.wall_confident_percent = count > 0 ? 100 * sure / count : 0;
  if (result.wall_confident_percent < 80) {
    result.doubts.push_back(
        message("chest wall uncertain on ", std::lround(100 - result.wall_confident_percent),
                " % of the breast's columns: look at it, correct with --chest-wall"));
  }
  if (result.nipple_from_extreme > 10) {
    result.doubts.push_back(message("nipple found ", std::lround(result.nipple_from_extreme),
                                    " mm from the most anterior point: look at it"));
  }
}

}  // namespace

Segmentation segment_breast(const Volume<float>& scan, const SegmentOptions& options,
                            Progress& progress, Timer& timer) {
  Work work;
  Segmentation result;
  {
    const Timer::Scope phase(timer, "body");
    progress.update("body", 0, "");
    work.scan = in_patient_order(scan);
    const auto& spacing = work.scan.grid.spacing;
    result.halved = spacing[0] < 1 && spacing[1] < 1;
    if (result.halved) work.scan = coarsened(work.scan, {2, 2, 1});
    work.body = find_body(work.scan);
    work.torso = find_torso(work.body.mask);
    work.skin_distance = signed_distance(work.body.mask);
    work.domain = wall_domain(work.body.mask, work.torso, options.side == Side::left);
  }
  find_wall(work, options, progress, timer);
  {
    const Timer::Scope phase(timer, "bias");
    BiasSettings settings;
    settings.window = 30;
    correct_bias(work, settings, [&](int i, int k) {
      return std::isnan(work.wall.depth.at(i, k)) ? work.torso.cleft[k] + 10
                                                  : work.wall.depth.at(i, k) - wall_clearance;
    });
    result.bias_cv_before = work.bias.fat_cv_before;
    result.bias_cv_after = work.bias.fat_cv_after;
  }
  const Timer::Scope phase(timer, "tissue");
  progress.update("tissue", 0.8, "");
  work.extent = find_extent(work.wall, work.domain, work.torso, work.skin_distance, options.side);
  work.breast =
      breast_voxels(work.body.mask, work.wall, work.domain, work.torso, work.extent, options.side);
  work.skin = skin_thickness(work.ratio, work.breast, work.skin_distance);
  work.gland = find_fibroglandular(work.ratio, interior_of(work, 3, work.scan.grid.spacing[1]),
                                   work.wall.muscle_ratio);
  result.labels = label(work, options.side);
  const Nipple nipple = find_nipple(work.breast, work.body.mask);
  result.labels.landmarks["nipple"] = nipple.position;
  result.nipple_from_extreme = nipple.from_extreme;
  result.points = data_points(work);
  summarise(result, work);
  return result;
}

}  // namespace breast
