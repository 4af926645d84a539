// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/scanner.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/statistics/percentile.hpp"
#include "phantom/random.hpp"

namespace breast {

namespace {

struct CoilElement {
  Vec3 at;
  double weight;
};

// Loops beside, between and below the two openings of a prone breast coil.
std::vector<CoilElement> coil(std::uint64_t seed) {
  RandomStream stream(seed);
  std::vector<CoilElement> elements;
  for (double side : {-1.0, 1.0}) {
    const Vec3 places[] = {{side * 165, -55, 0},
                           {side * 45, -75, 0},
                           {side * 100, -105, 0},
                           {side * 110, -50, -75},
                           {side * 110, -50, 75}};
    for (const Vec3& place : places) {
      const Vec3 moved = place + 8 * Vec3(stream.normal(), stream.normal(), stream.normal());
      elements.push_back({moved, stream.uniform(0.7, 1.3)});
    }
  }
  return elements;
}

double raw_sensitivity(const std::vector<CoilElement>& coil, const Vec3& x) {
  constexpr double loop = 60;  // mm, radius of a loop
  double sum = 0;
  for (const CoilElement& element : coil) {
    const double d2 = (x - element.at).squaredNorm() / (loop * loop);
    sum += element.weight / ((1 + d2) * std::sqrt(1 + d2));
  }
  return sum;
}

}  // namespace

Volume<float> coil_sensitivity(const PhantomImage& image, double bias, std::uint64_t seed) {
  if (!(bias >= 1 && bias <= 20))
    throw input_error("coil bias ", bias, ": must lie between 1 and 20");
  const Grid& grid = image.signal.grid;
  const std::vector<CoilElement> elements = coil(seed);
  Volume<float> field(grid);
#pragma omp parallel for schedule(static) num_threads(threads())
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
        field.at(i, j, k) =
            float(elementary::log(raw_sensitivity(elements, grid.to_patient(Vec3(i, j, k)))));
  std::vector<float> breast;
  for (std::size_t n = 0; n < grid.voxels(); ++n)
    if (image.side[n] > 0 && image.tissue[n] == std::uint8_t(Tissue::fat))
      breast.push_back(field.voxels[n]);
  if (breast.empty()) throw input_error("coil sensitivity: the image holds no breast");
  // Rounded: the scans of earlier versions are kept, bit for bit.
  const double spread = float(percentile(breast, 0.99)) - float(percentile(breast, 0.01));
  const double power = elementary::log(bias) / spread, middle = percentile(breast, 0.5);
#pragma omp parallel for schedule(static) num_threads(threads())
  for (std::size_t n = 0; n < grid.voxels(); ++n)
    field.voxels[n] = float(elementary::exp(power * (field.voxels[n] - middle)));
  return field;
}

Volume<std::int16_t> magnitude(const Volume<float>& signal_image, const Volume<float>& sensitivity,
                               double noise_percent, std::uint64_t seed, int image_number) {
  if (!(noise_percent >= 0 && noise_percent <= 100)) {
    throw input_error("noise ", noise_percent, " %: must lie between 0 and 100");
  }
  const Grid& grid = signal_image.grid;
  const double sigma = 0.01 * noise_percent * matter_signal(Matter::fat);
  const std::uint64_t texture = mix(seed, 402),
                      noise = mix(seed, 403 + 1000 * std::uint64_t(image_number));
  Volume<std::int16_t> out(grid);
#pragma omp parallel for schedule(static) num_threads(threads())
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        const Vec3 x = grid.to_patient(Vec3(i, j, k));
        double signal = signal_image.voxels[n];
        if (signal > 0) {
          signal *= sensitivity.voxels[n] * (1 + 0.05 * lattice_noise(texture, x / 6) +
                                             0.05 * lattice_noise(texture + 1, x / 25));
        }
        const Vec2 error = sigma * normal_pair(noise, n);
        const double size = std::hypot(signal + error.x(), error.y());
        out.voxels[n] = std::int16_t(std::clamp(std::lround(size), 0L, 32767L));
      }
  return out;
}

Volume<std::int16_t> scan(const PhantomImage& image, const MriParameters& p, std::uint64_t seed) {
  return magnitude(image.signal, coil_sensitivity(image, p.bias, mix(seed, 401)), p.noise_percent,
                   seed);
}

Volume<std::int16_t> suppressed_scan(const PhantomImage& image, const MriParameters& p,
                                     const ContrastParameters& contrast, std::uint64_t seed) {
  const Volume<float> failing = failing_region(image.signal, 0.01 * contrast.failed_percent, seed);
  return magnitude(saturated(image.parts, fat_left(contrast.muscle_over_fat), failing),
                   coil_sensitivity(image, p.bias, mix(seed, 401)), p.noise_percent, seed);
}

DixonScan dixon_scan(const PhantomImage& image, const MriParameters& p,
                     const ContrastParameters& contrast, std::uint64_t seed) {
  const SignalImages shown =
      exchanged(image.parts, failing_region(image.signal, 0.01 * contrast.failed_percent, seed));
  const Volume<float> sensitivity = coil_sensitivity(image, p.bias, mix(seed, 401));
  return {magnitude(shown.water, sensitivity, p.noise_percent, seed),
          magnitude(shown.fat, sensitivity, p.noise_percent, seed, 1)};
}

}  // namespace breast
