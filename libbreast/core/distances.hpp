// SPDX-License-Identifier: GPL-3.0-or-later
// Summary of distances between two shapes: mean, 95th percentile and maximum.
#pragma once

#include <vector>

namespace breast {

struct Distances {
  double mean_mm = 0, p95_mm = 0, max_mm = 0;
};

/// A distance (mm) and its weight: the area that it represents, or 1.
struct WeightedDistance {
  double distance, weight = 1;
};

/// The weighted mean, the smallest distance that is not exceeded by 95 % of the weight, and the
/// largest distance. All are zero if the weights sum to zero. The order of the samples does not
/// matter.
Distances summarise(std::vector<WeightedDistance> samples);
/// The same for distances of equal weight.
Distances summarise(const std::vector<double>& distances);

}  // namespace breast
