// Profile of a compression plate's rounded edge: what contact presses with and pictures show.
#pragma once

namespace breast {

/// Recession of a rounded edge of radius r, s mm beyond where it starts: r − √(r²−s²) up to s = 0.8
/// r, then straight with the slope reached there (4/3). r = 0 is a straight bevel of that slope.
struct EdgeRecession {
  double value = 0, slope = 0, curvature = 0;
};
EdgeRecession edge_recession(double radius, double s);

}  // namespace breast
