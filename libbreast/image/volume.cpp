// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/volume.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

double sample_linear(const Volume<float>& volume, const Vec3& patient, double outside) {
  const Vec3 index = volume.grid.to_index(patient);
  int low[3], high[3];
  double weight[3];
  for (int d = 0; d < 3; ++d) {
    const int last = volume.grid.size[d] - 1;
    if (!(index[d] >= -0.5 && index[d] <= last + 0.5)) return outside;
    const double x = std::clamp(index[d], 0.0, double(last));
    low[d] = std::min(int(x), std::max(last - 1, 0));
    high[d] = std::min(low[d] + 1, last);
    weight[d] = x - low[d];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const bool u = corner & 1, v = corner & 2, w = corner & 4;
    const double factor = (u ? weight[0] : 1 - weight[0]) * (v ? weight[1] : 1 - weight[1]) *
                          (w ? weight[2] : 1 - weight[2]);
    if (factor == 0) continue;
    sum += factor * volume.at(u ? high[0] : low[0], v ? high[1] : low[1], w ? high[2] : low[2]);
  }
  return sum;
}

}  // namespace breast
