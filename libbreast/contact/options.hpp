// SPDX-License-Identifier: GPL-3.0-or-later
// Parsing of the compression options of a command line.
#pragma once

#include <optional>
#include <string>

#include "contact/compression.hpp"

namespace breast {

/// Distance (mm) by which the detector lifts the breast: infinite for "raised", 0 for "fixed", or a
/// number ≥ 0. Throws Error (input) for anything else.
double parse_detector(const std::string& text);
/// Distance (mm) from the chest wall to the edge of the image; "auto" gives that of the view.
/// Throws Error (input) for anything else.
double parse_image_edge(const std::string& text, View view);
/// Angle (degrees) by which the plates' edge is turned; nothing for "auto", where it follows from
/// the chest wall. Throws Error (input) for anything else.
std::optional<double> parse_turn(const std::string& text);

/// The compression options as given on a command line.
struct CompressionChoices {
  std::string view = "CC", contact = "active-set", detector = "raised", image_edge, turn;
  std::string contact_points, positioning;  ///< empty: the default of compression_options
  std::optional<double> angle, thickness, reduction, force, pressure, plate_step;
  std::optional<double> friction, edge_radius, pull;
  PlateOptions plates;
  /// Number of targets given among thickness, reduction, force and pressure; it must be one.
  int targets() const;
};
/// `gravity` in mm/s², LPS. Plates that are placed by the edge of the image have the clinical
/// defaults: parallel to the chest wall, with an edge radius of 3 mm, surface contact with a
/// friction coefficient of 0.3, and a lifted breast pulled forwards by 30 N. Throws Error (input)
/// for an unknown view or detector, and for a reduction below 1 percent, which is probably a
/// fraction given by mistake.
CompressionOptions compression_options(const CompressionChoices& choices, const Vec3& gravity);

}  // namespace breast
