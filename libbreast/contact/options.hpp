// SPDX-License-Identifier: GPL-3.0-or-later
// The options of compression from their text on a command line.
#pragma once

#include <optional>
#include <string>

#include "contact/compression.hpp"

namespace breast {

/// mm by which the detector lifts the breast: "raised" infinite, "fixed" 0, or a number ≥ 0. Throws
/// Error (input) for anything else.
double parse_detector(const std::string& text);
/// mm from the front of the wall, or of a layer of `muscle_mm` on it, to the edge of the image; "auto":
/// that of the view. Throws Error (input) for anything else.
double parse_image_edge(const std::string& text, View view, double muscle_mm);
/// Degrees by which the plates' edge is turned; "auto": none, to be found from the wall. Throws Error
/// (input) for anything else.
std::optional<double> parse_turn(const std::string& text);

/// A compression as given on a command line.
struct CompressionChoices {
  std::string view = "CC", contact = "active-set", detector = "raised", image_edge, turn;
  std::string contact_points, positioning;  ///< empty: as plates, see compression_options
  std::optional<double> angle, thickness, reduction, force, pressure, area, plate_step;
  std::optional<double> friction, edge_radius, pull;
  PlateOptions plates;
  /// Those of thickness, reduction, force, pressure and area that are given; the first one reached ends the
  /// compression.
  std::vector<CompressionStop> stops() const;
};
/// `gravity` in mm/s², LPS. Plates placed by the edge of the image stand as in the clinic: turned along
/// the wall, with an edge of 3 mm, pressing on faces with a friction of 0.3, the breast lifted and pulled forwards by 30 N;
/// unless something else is
/// asked for. Throws Error (input) for a view or detector that is none, and for a
/// reduction below 1 percent, which is a fraction by mistake.
CompressionOptions compression_options(const CompressionChoices& choices, const Vec3& gravity,
                                       double muscle_mm = 0);

}  // namespace breast
