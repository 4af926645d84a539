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
/// Distance (mm) from the chest wall, or from the front of a layer of muscle of `muscle_mm`, to the
/// edge of the image; "auto" gives that of the view. Throws Error (input) for anything else.
double parse_image_edge(const std::string& text, View view, double muscle_mm);
/// Angle (degrees) by which the plates' edge is turned; no value for "auto", for which it follows
/// from the chest wall. Throws Error (input) for anything else.
std::optional<double> parse_turn(const std::string& text);
/// Angle (degrees) by which the plates' edge leans; as parse_turn.
std::optional<double> parse_lean(const std::string& text);

/// The compression options as given on a command line.
struct CompressionChoices {
  std::string view = "CC", contact = "active-set", detector = "raised", image_edge, turn, lean;
  std::string contact_points, positioning;  ///< empty: the default of compression_options
  std::optional<double> angle, thickness, reduction, force, pressure, area, plate_step;
  std::optional<double> friction, edge_radius, pull;
  PlateOptions plates;
  /// The targets given among thickness, reduction, force, pressure and area; the first one that is
  /// reached ends the compression.
  std::vector<CompressionStop> stops() const;
};
/// `gravity` in mm/s², LPS; `muscle_mm` is the thickness of the mesh's layer of muscle. Plates that
/// are placed by the edge of the image have the clinical defaults: parallel to the chest wall, with
/// an edge radius of 3 mm, surface contact with a friction coefficient of 0.15, and a lifted breast
/// pulled forwards by 30 N. Throws Error (input) for an unknown view or detector, and for a
/// reduction below 1 percent, which is probably a fraction given by mistake.
CompressionOptions compression_options(const CompressionChoices& choices, const Vec3& gravity,
                                       double muscle_mm = 0);

}  // namespace breast
