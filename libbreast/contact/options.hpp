// The options of compression from their text on a command line.
#pragma once

#include <optional>
#include <string>

#include "contact/compression.hpp"

namespace breast {

/// mm by which the detector lifts the breast: "raised" infinite, "fixed" 0, or a number ≥ 0. Throws
/// Error (input) for anything else.
double parse_detector(const std::string& text);

/// A compression as given on a command line.
struct CompressionChoices {
  std::string view = "CC", contact = "active-set", detector = "raised";
  std::optional<double> angle, thickness, reduction, force, pressure, plate_step;
  double friction = 0;
  PlateOptions plates;
  /// How many of thickness, reduction, force and pressure are given; one must be.
  int targets() const;
};
/// `gravity` in mm/s², LPS. Throws Error (input) for a view or detector that is none, and for a
/// reduction below 1 percent, which is a fraction by mistake.
CompressionOptions compression_options(const CompressionChoices& choices, const Vec3& gravity);

}  // namespace breast
