// SPDX-License-Identifier: GPL-3.0-or-later
// The thickness to which the plates close next.
#pragma once

#include <optional>
#include <vector>

#include "contact/path/target.hpp"

namespace breast {

/// Where a path may not pass without a stop; thicknesses in mm.
struct PathStops {
  std::optional<double> end;                ///< the path ends there at the latest
  std::vector<CompressionTarget> controls;  ///< targets that are not a thickness
  std::vector<double> corners;              ///< PathOptions::corners
};

/// Thickness (mm) a step of about `step` mm from the point `here`: closer to a control, which should
/// not be overshot by much; at a corner or at the end instead of just before or beyond it. `before`
/// is the point before `here`; null at the start of the path.
double next_thickness(double step, const PathPoint& here, const PathPoint* before,
                      const PathStops& stops);

}  // namespace breast
