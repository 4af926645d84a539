// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/distances.hpp"

#include <algorithm>
#include <utility>

namespace breast {

Distances summarise(std::vector<WeightedDistance> samples) {
  // By weight too, so that the sums do not depend on the order given.
  std::sort(samples.begin(), samples.end(),
            [](const WeightedDistance& a, const WeightedDistance& b) {
              return std::pair(a.distance, a.weight) < std::pair(b.distance, b.weight);
            });
  double total = 0, sum = 0;
  for (const auto& [distance, weight] : samples) {
    total += weight;
    sum += weight * distance;
  }
  if (!(total > 0)) return {};
  Distances result{sum / total, 0, samples.back().distance};
  double passed = 0;
  for (const auto& [distance, weight] : samples) {
    passed += weight;
    result.p95_mm = distance;
    if (passed >= 0.95 * total) break;
  }
  return result;
}

Distances summarise(const std::vector<double>& distances) {
  std::vector<WeightedDistance> samples;
  samples.reserve(distances.size());
  for (const double distance : distances) samples.push_back({distance});
  return summarise(std::move(samples));
}

}  // namespace breast
