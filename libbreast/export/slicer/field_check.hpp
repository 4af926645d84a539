// SPDX-License-Identifier: GPL-3.0-or-later
// Error of a displacement field against the element map that it samples.
#pragma once

#include "export/slicer/field.hpp"

namespace breast {

struct FieldCheck {
  int points = 0;                  ///< random points of the body, evenly spread over its volume
  double mean_mm = 0, max_mm = 0;  ///< field, interpolated trilinearly, against the element map
  double beyond_percent = 0;       ///< percentage of the points with an error above `accuracy_mm`
  double smallest_det = 0;  ///< of ∂(p + u)/∂p over the body's grid cells: above 0, nothing folds
  double outside_into_body_percent =
      0;  ///< of grid points outside the first shape, taken into the second
};

/// Expected accuracy of a field, mm.
inline constexpr double accuracy_mm = 0.05;

/// `count` points drawn from a fixed seed. `from` and `to` as given to displacement_field.
FieldCheck check_field(const DisplacementField& field, const HexTopology& mesh,
                       const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                       int count = 1000);

/// Mean and largest distance in mm between `count` random points of the body and their images under
/// the field followed by its inverse.
struct RoundTrip {
  double mean_mm = 0, max_mm = 0;
};
RoundTrip check_round_trip(const DisplacementField& field, const DisplacementField& inverse,
                           const HexTopology& mesh, const std::vector<Vec3>& from,
                           int count = 1000);

}  // namespace breast
