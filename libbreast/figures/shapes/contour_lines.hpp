// SPDX-License-Identifier: GPL-3.0-or-later
// Contour lines in a plane, from values at the points of a square grid that are smoothed and
// contoured.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Values at the points (column, row) * pixel in mm; row 0 is the lowest.
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
  /// The value of the nearest point; beyond the border that of the border.
  float near(const Vec2& mm) const;
};

using PlaneSegment = std::array<Vec2, 2>;

/// Gaussian smoothing with standard deviation `sigma_mm`; values beyond the border equal those on
/// the border.
PlaneField smoothed(const PlaneField& field, double sigma_mm);
/// The lines on which the bilinear field has the value `level`, in mm: one or two segments per
/// cell.
std::vector<PlaneSegment> contour_lines(const PlaneField& field, double level);

}  // namespace breast
