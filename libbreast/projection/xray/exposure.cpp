// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/xray/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double scatter_reach_mm = 8;

// Two-sided exponential of unit sum along one line: a forward and a backward first-order recursion.
void spread_line(float* values, int n, std::size_t stride, double decay,
                 std::vector<double>& work) {
  work.assign(std::size_t(n), 0);
  double forward = 0;
  for (int i = 0; i < n; ++i) {
    forward = decay * forward + values[std::size_t(i) * stride];
    work[std::size_t(i)] = forward;
  }
  const double norm = (1 - decay) / (1 + decay);
  double backward = 0;
  for (int i = n - 1; i >= 0; --i) {
    float& value = values[std::size_t(i) * stride];
    const double here = value;
    value = float(norm * (work[std::size_t(i)] + backward));
    backward = decay * (backward + here);
  }
}

std::vector<float> scattered(const Mammogram& image, double ratio) {
  std::vector<float> scatter(image.path.size(), 0);
  for (std::size_t i = 0; i < scatter.size(); ++i) {
    if (image.thickness[i] > 0) scatter[i] = float(ratio * std::exp(-image.path[i]));
  }
  const double decay = std::exp(-image.pixel / scatter_reach_mm);
  std::vector<double> work;
  for (int v = 0; v < image.height; ++v) {
    spread_line(&scatter[std::size_t(v) * image.width], image.width, 1, decay, work);
  }
  for (int u = 0; u < image.width; ++u) {
    spread_line(&scatter[std::size_t(u)], image.height, std::size_t(image.width), decay, work);
  }
  return scatter;
}

}  // namespace

void expose(Mammogram& image, const Exposure& exposure) {
  if (!(exposure.scatter_fraction >= 0 && exposure.scatter_fraction <= 0.9)) {
    throw input_error("scatter fraction ", exposure.scatter_fraction, ": 0 to 0.9 expected");
  }
  if (!(exposure.photons_per_mm2 >= 0)) {
    throw input_error("photons ", exposure.photons_per_mm2, " per mm2: must not be negative");
  }
  const bool scatters = exposure.scatter_fraction > 0, noisy = exposure.photons_per_mm2 > 0;
  if (!scatters && !noisy) return;
  if (image.shows_fraction()) {
    throw input_error("scatter and noise need photons: give --energy in keV or as a spectrum");
  }
  std::vector<float> scatter;
  if (scatters) {
    scatter = scattered(image, exposure.scatter_fraction / (1 - exposure.scatter_fraction));
  }
  const double photons = exposure.photons_per_mm2 * image.pixel * image.pixel;
#pragma omp parallel for schedule(static)
  for (int v = 0; v < image.height; ++v) {
    std::seed_seq seeds{exposure.seed, exposure.seed >> 32, std::uint64_t(v)};
    std::mt19937_64 stream(seeds);
    for (int u = 0; u < image.width; ++u) {
      const std::size_t i = std::size_t(v) * image.width + u;
      if (image.blank(i)) continue;
      double signal = std::exp(-double(image.path[i])) + (scatters ? scatter[i] : 0.0);
      if (noisy) {
        const double count = double(std::poisson_distribution<long>(photons * signal)(stream));
        signal = std::max(count, 0.5) / photons;
      }
      image.path[i] = float(std::max(0.0, -std::log(signal)));
    }
  }
}

}  // namespace breast
