// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/mr_contrast.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

struct Relaxation {
  double density, t1_ms;  ///< of the water
  double fat = 0;         ///< share of the protons that are fat's
};

constexpr double fat_t1_ms = 367;

/// In the order of Matter.
constexpr std::array<Relaxation, n_matters> relaxations{{
    {0, 1000},           // air
    {0.7, 1300, 0.05},   // skin
    {0.7, 1300, 0.02},   // nipple
    {1, 1000, 0.95},     // fat
    {0.8, 1000, 0.5},    // ligament
    {1, 1445, 0.06},     // gland
    {0.75, 1412, 0.03},  // muscle
    {0.1, 1000},         // cortex
    {0.9, 1000, 0.6},    // marrow
    {0.7, 1200, 0.02},   // cartilage
    {0.2, 1200},         // lung
    {0.8, 1471},         // heart
    {0.9, 1932},         // blood
    {0.8, 812, 0.03},    // liver
    {0.8, 1300, 0.1},    // brawn
}};

double steady_state(double t1_ms) {
  constexpr double repetition_ms = 5, flip = 10 * std::numbers::pi / 180;
  const double e1 = elementary::exp(-repetition_ms / t1_ms);
  return elementary::sin(flip) * (1 - e1) / (1 - elementary::cos(flip) * e1);
}

}  // namespace

WaterFat matter_water_fat(Matter matter) {
  const Relaxation& r = relaxations[std::size_t(matter)];
  const Relaxation& of_fat = relaxations[std::size_t(Matter::fat)];
  const double scale = 1000 / (of_fat.fat * steady_state(fat_t1_ms) +
                               (1 - of_fat.fat) * of_fat.density * steady_state(of_fat.t1_ms));
  return {scale * (1 - r.fat) * r.density * steady_state(r.t1_ms),
          scale * r.fat * steady_state(fat_t1_ms)};
}

double fat_left(double muscle_over_fat) {
  const WaterFat muscle = matter_water_fat(Matter::muscle), fat = matter_water_fat(Matter::fat);
  const double most = muscle.water / fat.water, least = 0.9;
  if (!(muscle_over_fat >= least && muscle_over_fat < most)) {
    throw input_error("muscle over fat ", muscle_over_fat, ": must lie between ", least,
                      " and the ", most, " that the water in fat allows");
  }
  return (muscle.water - muscle_over_fat * fat.water) / (muscle_over_fat * fat.fat - muscle.fat);
}

Volume<float> failing_region(const Volume<float>& body, double share, std::uint64_t seed) {
  constexpr double width = 4;  // mm
  Volume<float> weight(body.grid);
  if (!(share > 0)) return weight;
  // Distances in the box of the body, from a point at its side, low and in its front half.
  const auto& size = body.grid.size;
  std::array<int, 3> first = size, last{};
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        if (!(body.at(i, j, k) > 0)) continue;
        const std::array<int, 3> at{i, j, k};
        for (int d = 0; d < 3; ++d) {
          first[d] = std::min(first[d], at[d]);
          last[d] = std::max(last[d], at[d]);
        }
      }
  const Vec3 part(seed % 2 ? 0.95 : 0.05, 0.35, 0.3);
  Vec3 centre;
  for (int d = 0; d < 3; ++d) centre[d] = first[d] + part[d] * (last[d] - first[d]);
  std::vector<float> distances;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        const Vec3 away = (Vec3(i, j, k) - centre).cwiseProduct(body.grid.spacing);
        weight.at(i, j, k) = float(away.norm());
        if (body.at(i, j, k) > 0) distances.push_back(weight.at(i, j, k));
      }
  if (distances.empty()) return Volume<float>(body.grid);
  const double radius = percentile(std::move(distances), share);
  for (float& value : weight.voxels)
    value = float(1 / (1 + elementary::exp((value - radius) / (0.5 * width))));
  return weight;
}

SignalImages exchanged(SignalImages images, const Volume<float>& failing) {
  for (std::size_t n = 0; n < failing.voxels.size(); ++n)
    if (failing.voxels[n] > 0.5f) std::swap(images.water.voxels[n], images.fat.voxels[n]);
  return images;
}

Volume<float> saturated(const SignalImages& images, double left, const Volume<float>& failing) {
  Volume<float> out = images.water;
  for (std::size_t n = 0; n < out.voxels.size(); ++n) {
    const double all = failing.voxels.empty() ? 0 : failing.voxels[n];
    out.voxels[n] += float((left + (1 - left) * all) * images.fat.voxels[n]);
  }
  return out;
}

}  // namespace breast
