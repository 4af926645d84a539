// The options of compression from their text on a command line.
#pragma once

#include <optional>
#include <string>

#include "contact/compression.hpp"

namespace breast {

/// "fixed": none; "spring:NORMAL" or "spring:NORMAL,TANGENTIAL" in kPa/mm. Without the second: a
/// third of the first, as for a thin layer of incompressible elastic tissue whose sides are free
/// (E/h across, G/h = E/3h along). Throws Error (input) for anything else.
std::optional<SupportStiffness> parse_wall(const std::string& text);

/// mm by which the detector lifts the breast: "raised" infinite, "fixed" 0, or a number ≥ 0. Throws
/// Error (input) for anything else.
double parse_detector(const std::string& text);

/// A compression as given on a command line.
struct CompressionChoices {
  std::string view = "CC", contact = "active-set", wall = "fixed", detector = "raised";
  std::optional<double> angle, thickness, reduction, force, pressure, plate_step;
  double friction = 0;
  PlateOptions plates;
  /// How many of thickness, reduction, force and pressure are given; one must be.
  int targets() const;
};
/// `gravity` in mm/s², LPS. Throws Error (input) for a view, wall or detector that is none, and for a
/// reduction below 1 percent, which is a fraction by mistake.
CompressionOptions compression_options(const CompressionChoices& choices, const Vec3& gravity);

}  // namespace breast
