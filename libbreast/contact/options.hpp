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
/// Angle (degrees) by which the patient bends forwards; as parse_turn.
std::optional<double> parse_bend(const std::string& text);

/// The compression options as given on a command line.
struct CompressionChoices {
  std::string view = "CC", contact = "active-set", detector = "raised", image_edge, turn, lean,
              bend;
  std::string contact_points, positioning;  ///< empty: the default of compression_options
  std::optional<double> angle, thickness, reduction, force, pressure, area, plate_step;
  std::optional<double> friction, edge_radius, pull;
  int most_iterations = PathOptions().most_iterations;
  PlateOptions plates;
  /// The targets given among thickness, reduction, force, pressure and area; the first one that is
  /// reached ends the compression.
  std::vector<CompressionStop> stops() const;
};

/// How plates stand and hold a breast, unless options say otherwise.
struct Placement {
  double edge_radius = PlateOptions().edge_radius;                 ///< mm
  std::optional<double> turn_deg = 0, lean_deg = 0, bend_deg = 0;  ///< as in PlateOptions
  double most_turn_deg = PlateOptions().most_turn_deg;
  ContactMethod method = ContactMethod::active_set;
  double friction = 0;  ///< of faces on plates
  Positioning positioning = Positioning::hanging;
  double pull_N = 0;  ///< of a lifted breast that friction holds
  /// As in the clinic, with the edge of the plates at the edge of the image: parallel to the chest
  /// wall, in CC with a sharper edge, and a breast that is lifted, pulled forwards and held by friction.
  static Placement clinical(View view);
};

/// What the defaults of a compression depend on besides the command line.
struct CompressedBody {
  /// A breast that slides on its chest wall lies limp between plates that stand far in front of it:
  /// unless --standoff is given, they are placed by the edge of the image.
  bool slides = false;
  double muscle_mm = 0;  ///< thickness of the mesh's layer of muscle
};

/// `gravity` in mm/s², LPS. Plates that are placed by the edge of the image have the clinical
/// defaults. Throws Error (input) for an unknown view or detector, and for a reduction below 1
/// percent, which is probably a fraction given by mistake.
CompressionOptions compression_options(const CompressionChoices& choices, const Vec3& gravity,
                                       const CompressedBody& body = {});

}  // namespace breast
