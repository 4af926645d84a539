// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/shapes/contour_lines.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

/// One pass along rows (`stride` 1) or columns (`stride` width).
void smooth_along(PlaneField& field, const std::vector<double>& weights, bool rows) {
  const PlaneField before = field;
  const int reach = int(weights.size()) - 1;
  for (int row = 0; row < field.height; ++row) {
    for (int column = 0; column < field.width; ++column) {
      double sum = 0;
      for (int k = -reach; k <= reach; ++k) {
        const int c = std::clamp(column + (rows ? k : 0), 0, field.width - 1);
        const int r = std::clamp(row + (rows ? 0 : k), 0, field.height - 1);
        sum += weights[std::size_t(std::abs(k))] * before.at(c, r);
      }
      field.at(column, row) = float(sum);
    }
  }
}

}  // namespace

float PlaneField::near(const Vec2& mm) const {
  return at(std::clamp(int(std::lround(mm.x() / pixel)), 0, width - 1),
            std::clamp(int(std::lround(mm.y() / pixel)), 0, height - 1));
}

PlaneField smoothed(const PlaneField& field, double sigma_mm) {
  const double sigma = sigma_mm / field.pixel;
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k <= int(std::ceil(3 * sigma)); ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
    sum += (k == 0 ? 1 : 2) * weights.back();
  }
  for (double& weight : weights) weight /= sum;
  PlaneField out = field;
  smooth_along(out, weights, true);
  smooth_along(out, weights, false);
  return out;
}

std::vector<PlaneSegment> contour_lines(const PlaneField& field, double level) {
  std::vector<PlaneSegment> lines;
  for (int row = 0; row + 1 < field.height; ++row) {
    for (int column = 0; column + 1 < field.width; ++column) {
      // Crossings of the cell's edges, in order around it; a cell with four of them is a saddle.
      const std::array<std::array<int, 2>, 4> corner{
          {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}}};
      std::array<Vec2, 4> crossing;
      std::size_t count = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& [i, j] = corner[k];
        const auto& [m, n] = corner[(k + 1) % 4];
        const double a = field.at(i, j), b = field.at(m, n);
        if ((a > level) == (b > level)) continue;
        const double f = (level - a) / (b - a);
        crossing[count++] = field.pixel * ((1 - f) * Vec2(i, j) + f * Vec2(m, n));
      }
      for (std::size_t k = 0; k + 1 < count; k += 2) {
        lines.push_back({crossing[k], crossing[k + 1]});
      }
    }
  }
  return lines;
}

}  // namespace breast
