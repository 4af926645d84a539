// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/grid/noise.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/statistics/percentile.hpp"
#include "segment/grid/filters.hpp"

namespace breast {

double corner_air_level(const Volume<float>& scan) {
  const auto& size = scan.grid.size;
  const int width = std::max(1, size[0] / 10), depth = std::max(1, size[1] / 10);
  std::vector<float> air;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) {
        air.push_back(scan.at(i, j, k));
        air.push_back(scan.at(size[0] - 1 - i, j, k));
      }
    }
  }
  return percentile(std::move(air), 0.9);
}

Volume<float> without_noise(const Volume<float>& scan, double noise) {
  constexpr double width = 1.5;  // mm
  if (!(noise > 0)) return scan;
  Volume<float> signal = scan;
  for (float& v : signal.voxels) v *= v;
  signal = gaussian(std::move(signal), width);
  const float second_moment = float(2 * noise * noise);
  for (float& v : signal.voxels) v = std::sqrt(std::max(v - second_moment, 0.0F));
  return signal;
}

Noise noise_of(const Volume<float>& scan) {
  constexpr double rayleigh = 2.146;  // its 90th percentile over the standard deviation
  const double air = corner_air_level(scan);
  std::vector<float> tissue = scan.voxels;
  std::erase_if(tissue, [&](float v) { return v < air; });
  if (tissue.empty()) return {};
  const double bright = percentile(std::move(tissue), 0.9);
  return {air / rayleigh, bright > 0 ? air / rayleigh / bright : 0};
}

bool is_speckle(const Noise& noise) {
  constexpr double least = 0.04;
  return noise.share > least;
}

void remove_speckle(Volume<float>& scan) {
  constexpr int width = 3;
  const auto& size = scan.grid.size;
  for (int k = 0; k < size[2]; ++k) {
    cv::Mat slice(size[1], size[0], CV_32F, &scan.at(0, 0, k));
    cv::medianBlur(slice.clone(), slice, width);
  }
}

double disturbing_noise(const Volume<float>& scan, const Noise& noise) {
  constexpr double least = 0.06, hidden = 2.5, share = 0.25;
  if (!(noise.share > least)) return 0;
  std::vector<float> body = without_noise(scan, noise.deviation).voxels;
  std::erase_if(body, [&](float v) { return v < noise.deviation; });
  return percentile(std::move(body), share, 0) < hidden * noise.deviation ? noise.deviation : 0;
}

}  // namespace breast
