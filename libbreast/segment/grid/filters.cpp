// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/grid/filters.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace breast {

namespace {

/// Applies line(in, out) to every grid line along axis d; `in` begins `radius` values before the line
/// and ends as many after it, its end values repeated.
template <class Line>
void along_axis(Volume<float>& volume, int d, int radius, const Line& line) {
  const auto& size = volume.grid.size;
  const int n = size[d];
  const std::size_t stride = d == 0 ? 1 : d == 1 ? size[0] : std::size_t(size[0]) * size[1];
  const int e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
#pragma omp parallel
  {
    std::vector<float> in(n + 2 * radius), out(n);
#pragma omp for
    for (int b = 0; b < size[f]; ++b) {
      for (int a = 0; a < size[e]; ++a) {
        std::array<int, 3> start{};
        start[e] = a;
        start[f] = b;
        float* first = &volume.at(start[0], start[1], start[2]);
        for (int m = 0; m < n; ++m) in[radius + m] = first[m * stride];
        std::fill_n(in.begin(), radius, in[radius]);
        std::fill_n(in.end() - radius, radius, in[radius + n - 1]);
        line(in.data(), out);
        for (int m = 0; m < n; ++m) first[m * stride] = out[m];
      }
    }
  }
}

std::vector<float> gaussian_taps(double sigma) {
  const int radius = int(std::ceil(3 * sigma));
  std::vector<float> taps(radius + 1);
  double sum = 0;
  for (int m = 0; m <= radius; ++m) {
    const double value = sigma > 0 ? elementary::exp(-0.5 * m * m / (sigma * sigma)) : 1;
    taps[m] = float(value);
    sum += (m ? 2 : 1) * value;
  }
  for (float& tap : taps) tap = float(tap / sum);
  return taps;
}

}  // namespace

Volume<float> gaussian(Volume<float> volume, double sigma) {
  for (int d = 0; d < 3; ++d) {
    const std::vector<float> taps = gaussian_taps(sigma / volume.grid.spacing[d]);
    const int radius = int(taps.size()) - 1;
    if (radius == 0) continue;
    along_axis(volume, d, radius, [&](const float* in, std::vector<float>& result) {
      const int n = int(result.size());
      for (int m = 0; m < n; ++m) result[m] = taps[0] * in[radius + m];
      for (int r = 1; r <= radius; ++r) {
        const float *before = in + radius - r, *after = in + radius + r, tap = taps[r];
        for (int m = 0; m < n; ++m) result[m] += tap * (before[m] + after[m]);
      }
    });
  }
  return volume;
}

Volume<float> box_maximum(Volume<float> volume, double half) {
  for (int d = 0; d < 3; ++d) {
    const int radius = int(half / volume.grid.spacing[d]);
    along_axis(volume, d, radius, [&](const float* in, std::vector<float>& result) {
      const int n = int(result.size());
      std::copy_n(in, n, result.begin());
      for (int r = 1; r <= 2 * radius; ++r)
        for (int m = 0; m < n; ++m) result[m] = std::max(result[m], in[m + r]);
    });
  }
  return volume;
}

}  // namespace breast
