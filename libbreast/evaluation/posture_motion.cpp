// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/posture_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mesh/muscle_front.hpp"
#include "mesh/quality.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

namespace {

constexpr double bounds[] = {0, 20, 40, std::numeric_limits<double>::infinity()};

/// One element: its volume in the scan, and its centre in both postures.
struct Sample {
  double volume = 0, moved = 0, before = 0, after = 0;
};

std::vector<Sample> samples_of(const HexMesh& mesh, const ThoraxSurface& surface,
                               double muscle_mm) {
  const std::vector<double> volumes = element_volumes(mesh, mesh.imaged);
  std::vector<Sample> samples;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[std::size_t(e)] == Tissue::muscle || is_around_breast(mesh, e)) continue;
    const Vec3 from = element_position(mesh, mesh.imaged, e, Vec3::Zero());
    const Vec3 to = element_position(mesh, mesh.points, e, Vec3::Zero());
    samples.push_back({volumes[std::size_t(e)], (to - from).norm(),
                       wall_surface_distance(surface, from) + muscle_mm,
                       wall_surface_distance(surface, to) + muscle_mm});
  }
  return samples;
}

// The nipple in the body's frame, as it is measured in women.
void place_nipple(const ThoraxSurface& surface, const Vec3& before, const Vec3& after,
                  PostureMotion& motion) {
  const double notch_z =
      std::clamp(before.z() + notch_height_mm, surface.origin.z() + surface.height_low,
                 surface.origin.z() + surface.height_high);
  const double notch_y = surface.point(0, notch_z - surface.origin.z()).y();
  motion.nipples_apart_before = 2 * std::abs(before.x() - surface.origin.x());
  motion.nipples_apart_after = 2 * std::abs(after.x() - surface.origin.x());
  motion.before_notch_before = notch_y - before.y();
  motion.before_notch_after = notch_y - after.y();
}

double mean(const std::vector<Sample>& samples, double Sample::*value) {
  double sum = 0, total = 0;
  for (const Sample& sample : samples) {
    sum += sample.volume * sample.*value;
    total += sample.volume;
  }
  return total > 0 ? sum / total : 0;
}

// The change of the distance from the ribs at the distance `at`, by weighted linear regression; 0 without tissue.
double regressed_change(const std::vector<Sample>& samples, double at) {
  if (samples.empty()) return 0;
  const double before = mean(samples, &Sample::before), after = mean(samples, &Sample::after);
  double along = 0, square = 0;
  for (const Sample& sample : samples) {
    const double apart = sample.before - before;
    along += sample.volume * apart * (sample.after - sample.before - (after - before));
    square += sample.volume * apart * apart;
  }
  return after - before + (square > 0 ? along / square * (at - before) : 0);
}

double median_ratio(const std::vector<Sample>& samples) {
  std::vector<std::pair<double, double>> ratios;
  double total = 0;
  for (const Sample& sample : samples) {
    if (!(sample.before > 0)) continue;
    ratios.emplace_back(sample.after / sample.before, sample.volume);
    total += sample.volume;
  }
  std::sort(ratios.begin(), ratios.end());
  double sum = 0;
  for (const auto& [ratio, volume] : ratios) {
    sum += volume;
    if (2 * sum >= total) return ratio;
  }
  return 0;
}

}  // namespace

std::vector<MotionQuantity> motion_quantities(const PostureMotion& m) {
  std::vector<MotionQuantity> list{{"nipple_moved_mm", m.nipple_moved},
                                   {"nipple_lateral_mm", m.nipple_lateral},
                                   {"nipple_posterior_mm", m.nipple_posterior},
                                   {"nipple_caudal_mm", m.nipple_caudal},
                                   {"nipples_apart_before_mm", m.nipples_apart_before},
                                   {"nipples_apart_after_mm", m.nipples_apart_after},
                                   {"before_notch_before_mm", m.before_notch_before},
                                   {"before_notch_after_mm", m.before_notch_after},
                                   {"ribs_before_mm", m.ribs_before},
                                   {"ribs_after_mm", m.ribs_after},
                                   {"ribs_change_mm", m.ribs_after - m.ribs_before}};
  const char* names[] = {"0_20", "20_40", "above_40"};
  for (std::size_t k = 0; k < m.bins.size(); ++k) {
    const std::string name = names[k];
    const DepthBin& bin = m.bins[k];
    list.push_back({"volume_" + name + "_percent", 100 * bin.fraction});
    list.push_back({"moved_" + name + "_mm", bin.moved, bin.fraction});
    list.push_back({"change_" + name + "_mm", bin.change, bin.fraction});
    if (k + 1 == m.bins.size()) list.push_back({"change_at_71_mm", m.far_change, bin.fraction});
  }
  list.push_back({"moved_near_wall_mm", m.nearest_moved});
  return list;
}

double wall_surface_distance(const ThoraxSurface& surface, const Vec3& x) {
  constexpr int rounds = 25;
  constexpr double along = 0.6;  // of the way along the surface, which is curved
  const std::optional<Level> at = surface.at(x);
  if (!at) throw failed_error("a point at ", x.transpose(), " mm lies beyond the wall surface");
  Vec3 foot = x, best = x - at->value / at->gradient.squaredNorm() * at->gradient;
  for (int i = 0; i < rounds; ++i) {
    const std::optional<Level> level = surface.at(foot);
    if (!level) break;
    foot -= level->value / level->gradient.squaredNorm() * level->gradient;
    best = foot;
    const Vec3 normal = level->gradient.normalized(), away = x - foot;
    foot += along * (away - away.dot(normal) * normal);
  }
  return std::copysign((x - best).norm(), at->value);
}

PostureMotion posture_motion(const HexMesh& mesh, double assumed_muscle_mm) {
  if (!mesh.geometry || !mesh.geometry->thorax) {
    throw input_error(
        "mesh: it has no chest-wall surface from which distances are measured; "
        "run fit-hermite and hexmesh again");
  }
  const Landmark* nipple = mesh.landmark("nipple");
  if (nipple == nullptr) throw input_error("mesh: it has no landmark 'nipple'");
  // Behind a layer of muscle the surface is that of the ribs.
  const double muscle_mm = muscle_thickness(mesh) > 0 ? 0 : assumed_muscle_mm;
  PostureMotion motion;
  const Vec3 before = landmark_position(mesh, mesh.imaged, *nipple),
             after = landmark_position(mesh, mesh.points, *nipple), moved = after - before;
  place_nipple(*mesh.geometry->thorax, before, after, motion);
  motion.nipple_lateral = mesh.side == Side::left ? moved.x() : -moved.x();
  motion.nipple_posterior = moved.y();
  motion.nipple_caudal = -moved.z();
  motion.nipple_moved = moved.norm();
  const std::vector<Sample> samples = samples_of(mesh, *mesh.geometry->thorax, muscle_mm);
  motion.ribs_before = mean(samples, &Sample::before);
  motion.ribs_after = mean(samples, &Sample::after);
  motion.ratio = median_ratio(samples);
  double total = 0;
  for (const Sample& sample : samples) total += sample.volume;
  for (std::size_t k = 0; k + 1 < std::size(bounds); ++k) {
    std::vector<Sample> within;
    double volume = 0;
    for (const Sample& sample : samples) {
      if (!(sample.before >= bounds[k] && sample.before < bounds[k + 1])) continue;
      within.push_back(sample);
      volume += sample.volume;
    }
    motion.bins.push_back({bounds[k], bounds[k + 1], volume / total, mean(within, &Sample::moved),
                           mean(within, &Sample::after) - mean(within, &Sample::before)});
    if (k + 2 == std::size(bounds)) motion.far_change = regressed_change(within, far_landmark_mm);
  }
  std::vector<Sample> near;
  for (const Sample& sample : samples) {
    if (sample.before - muscle_mm < 20) near.push_back(sample);
  }
  motion.nearest_moved = mean(near, &Sample::moved);
  return motion;
}

}  // namespace breast
