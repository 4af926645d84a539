#include "mesh/plate_edge.hpp"

#include <cmath>

namespace breast {

namespace {
/// The rounded edge becomes straight at this fraction of its radius (methods: slope 4/3 there).
constexpr double straight_from = 0.8;
constexpr double straight_slope = 4.0 / 3.0;
}  // namespace

EdgeRecession edge_recession(double radius, double s) {
  if (!(s > 0)) return {};
  const double limit = straight_from * radius;
  if (s < limit) {
    const double root = std::sqrt(radius * radius - s * s);
    return {radius - root, s / root, radius * radius / (root * root * root)};
  }
  return {0.4 * radius + straight_slope * (s - limit), straight_slope, 0};
}

}  // namespace breast
