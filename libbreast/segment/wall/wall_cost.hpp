// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of a chest wall at each depth of an image column.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "segment/wall/chest_wall.hpp"

namespace breast {

/// Profile of ratio along j for one column, averaged over the 3 x 3 neighbouring columns.
std::vector<float> column_profile(const Volume<float>& ratio, int i, int k);

/// Running means of the fat index f = clip((r - m)/(1 - m)) 8 mm in front of and
/// 10 mm behind every voxel.
struct Windows {
  std::vector<double> sum;  // prefix sums of f
  double spacing;
  Windows(const std::vector<float>& profile, double muscle, double step) : spacing(step) {
    sum.assign(profile.size() + 1, 0);
    for (std::size_t j = 0; j < profile.size(); ++j) {
      sum[j + 1] = sum[j] + std::clamp((profile[j] - muscle) / (1 - muscle), 0.0, 1.0);
    }
  }
  double mean(int from, int to) const {  // voxels from <= j < to
    from = std::clamp(from, 0, int(sum.size()) - 2);
    to = std::clamp(to, from + 1, int(sum.size()) - 1);
    return (sum[to] - sum[from]) / (to - from);
  }
  int voxels(double mm) const { return std::max(1, int(std::lround(mm / spacing))); }
  double behind(int j) const { return mean(j, j + voxels(10.0)); }
  double front(int j) const { return mean(j - voxels(8.0), j); }
  double drop(int j) const { return mean(j - voxels(2.5), j) - mean(j, j + voxels(2.5)); }
};

struct Levels {
  int first = 0, count = 0;  // voxels j
};

/// Fills one column's costs at the given levels: bright in front, dark behind and a drop between
/// are cheap. `prior` (may be null) increases the cost of depths far from it.
void column_cost(const Volume<float>& ratio, const WallDomain& domain, const HeightField* prior,
                 double muscle, const Levels& levels, int i, int k, float* cost);

}  // namespace breast
