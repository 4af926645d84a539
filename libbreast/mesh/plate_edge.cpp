// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/plate_edge.hpp"

#include <cmath>
#include <limits>

namespace breast {

double edge_recession(double radius, double s) {
  if (!(s > 0)) return 0;
  if (!(s < radius)) return std::numeric_limits<double>::infinity();
  return radius - std::sqrt(radius * radius - s * s);
}

}  // namespace breast
