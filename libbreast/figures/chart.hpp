// SPDX-License-Identifier: GPL-3.0-or-later
// A line chart over a panel: axes with round ticks, curves with markers, shaded clinical ranges.
#pragma once

#include <string>
#include <vector>

#include "figures/canvas.hpp"

namespace breast {

/// One axis; a logarithmic axis needs 0 < low.
struct Axis {
  std::string title;
  /// Values at the start and the end; the axis runs backwards if low > high.
  double low = 0, high = 1;
  bool logarithmic = false;
};

class Chart {
 public:
  /// Draws frame, ticks and titles.
  Chart(Panel& panel, const Axis& across, const Axis& upwards);
  /// Draws a horizontal band of values.
  void band(double low, double high, const Colour& colour, const std::string& label);
  /// Points outside the axes are omitted, with the segments that lead to them.
  void curve(const std::vector<Vec2>& points, const Colour& colour, double width, bool dashed);
  /// Adds one line to the legend, from the top.
  void legend(const std::string& words, const Colour& colour, bool dashed);
  void frame();

 private:
  Vec2 pixel(const Vec2& value) const;
  bool inside(const Vec2& value) const;
  void piece(const Vec2& from, const Vec2& to, const Colour& colour, double width, bool dashed);

  Panel& panel_;
  Axis across_, upwards_;
  Vec2 corner_, extent_;  ///< pixels
  int lines_ = 0;
};

}  // namespace breast
