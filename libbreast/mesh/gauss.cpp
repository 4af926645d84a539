// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/gauss.hpp"

#include <cmath>

namespace breast {

GaussLine gauss_line(int n) {
  if (n == 2) return {{-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}, {1, 1}};
  return {{-std::sqrt(0.6), 0, std::sqrt(0.6)}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
}

std::vector<GaussSquarePoint> gauss_square(int n) {
  const GaussLine line = gauss_line(n);
  std::vector<GaussSquarePoint> points;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      points.push_back({Vec2(line.at[i], line.at[j]), line.weight[i] * line.weight[j]});
    }
  }
  return points;
}

std::vector<GaussCubePoint> gauss_cube(int n) {
  const GaussLine line = gauss_line(n);
  std::vector<GaussCubePoint> points;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        points.push_back({Vec3(line.at[i], line.at[j], line.at[k]),
                          line.weight[i] * line.weight[j] * line.weight[k]});
      }
    }
  }
  return points;
}

}  // namespace breast
