// SPDX-License-Identifier: GPL-3.0-or-later
// A grey-scale image with coloured lines and areas drawn over it, in pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace breast {

using Colour = std::array<std::uint8_t, 3>;

/// Pixel (0,0) is the top left one; integer coordinates are pixel centres.
class ColourPicture {
 public:
  /// `grey` from 0 to 1, rows from the top; values beyond are clipped.
  ColourPicture(int width, int height, const std::vector<float>& grey);

  // Drawing collects the covered pixels, each only once ...
  void line(const std::vector<Vec2>& points, double width);
  void disc(const Vec2& centre, double radius);
  void quadrilateral(const std::array<Vec2, 4>& corners);
  /// ... which are then painted with this colour at this opacity.
  void paint(const Colour& colour, double opacity);

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint8_t>& rgb() const { return rgb_; }

 private:
  void segment(const Vec2& a, const Vec2& b, double half_width);

  int width_, height_;
  std::vector<std::uint8_t> rgb_;
  std::vector<float> coverage_;  ///< coverage of the collected pixels, 0 to 1
};

}  // namespace breast
