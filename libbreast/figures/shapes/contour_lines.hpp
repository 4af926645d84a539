// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of equal value in a plane: values at the points of a square grid, smoothed and contoured.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Values at points (column, row) * pixel, mm; row 0 is the lowest.
struct PlaneField {
  int width = 0, height = 0;
  double pixel = 1;
  std::vector<float> values;

  PlaneField(int columns, int rows, double pixel_mm)
      : width(columns),
        height(rows),
        pixel(pixel_mm),
        values(std::size_t(columns) * std::size_t(rows), 0) {}
  float& at(int column, int row) { return values[std::size_t(row) * width + column]; }
  float at(int column, int row) const { return values[std::size_t(row) * width + column]; }
  /// Value of the nearest point; the border's beyond it.
  float near(const Vec2& mm) const;
};

using PlaneSegment = std::array<Vec2, 2>;

/// Weighted means over neighbours, Gaussian of `sigma_mm`; the border's values continue beyond it.
PlaneField smoothed(const PlaneField& field, double sigma_mm);
/// Where the bilinear field crosses the level, in mm: one or two segments a cell.
std::vector<PlaneSegment> contour_lines(const PlaneField& field, double level);

}  // namespace breast
