#include "segment/grid/filters.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

/// Applies line(in, out, n) to every grid line along axis d.
template <class Line>
void along_axis(Volume<float>& volume, int d, const Line& line) {
  const auto& size = volume.grid.size;
  const int n = size[d];
  const std::size_t stride = d == 0 ? 1 : d == 1 ? size[0] : std::size_t(size[0]) * size[1];
  const int e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
#pragma omp parallel
  {
    std::vector<float> in(n), out(n);
#pragma omp for
    for (int b = 0; b < size[f]; ++b) {
      for (int a = 0; a < size[e]; ++a) {
        std::array<int, 3> start{};
        start[e] = a;
        start[f] = b;
        float* first = &volume.at(start[0], start[1], start[2]);
        for (int m = 0; m < n; ++m) in[m] = first[m * stride];
        line(in, out);
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
    const double value = sigma > 0 ? std::exp(-0.5 * m * m / (sigma * sigma)) : 1;
    taps[m] = float(value);
    sum += (m ? 2 : 1) * value;
  }
  for (float& tap : taps) tap = float(tap / sum);
  return taps;
}

}  // namespace

Volume<float> gaussian(const Volume<float>& volume, double sigma) {
  Volume<float> out = volume;
  for (int d = 0; d < 3; ++d) {
    const std::vector<float> taps = gaussian_taps(sigma / volume.grid.spacing[d]);
    const int radius = int(taps.size()) - 1;
    if (radius == 0) continue;
    along_axis(out, d, [&](const std::vector<float>& in, std::vector<float>& result) {
      const int n = int(in.size());
      for (int m = 0; m < n; ++m) {
        float sum = taps[0] * in[m];
        for (int r = 1; r <= radius; ++r) {
          sum += taps[r] * (in[std::max(m - r, 0)] + in[std::min(m + r, n - 1)]);
        }
        result[m] = sum;
      }
    });
  }
  return out;
}

Volume<float> box_maximum(const Volume<float>& volume, double half) {
  Volume<float> out = volume;
  for (int d = 0; d < 3; ++d) {
    const int radius = int(half / volume.grid.spacing[d]);
    along_axis(out, d, [&](const std::vector<float>& in, std::vector<float>& result) {
      const int n = int(in.size());
      for (int m = 0; m < n; ++m) {
        result[m] = *std::max_element(in.begin() + std::max(m - radius, 0),
                                      in.begin() + std::min(m + radius + 1, n));
      }
    });
  }
  return out;
}

}  // namespace breast
