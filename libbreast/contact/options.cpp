// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/options.hpp"

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

/// Automatic longest step, as a fraction of the initial thickness, between inclined plates that hold
/// the breast by friction, while the hand lets it go: along these plates it slips farther than in
/// CC, and its end depends on the steps in which it slips.
constexpr double slipping_part = 0.006;
/// Default distance from the chest wall to the edge of the image, mm. The oblique view shows muscle:
/// in a mesh with a layer of muscle the edge lies behind its front by this fraction of its thickness.
constexpr double edge_cc = 5, edge_in_muscle = 1.25;
/// The farthest from there in CC that images show in practice, mm: a third of them show muscle (Mercer et al. 2015).
constexpr double farthest_edge_cc = 10;
/// Default radius of the rounded edge, mm. In oblique views it presses into the muscle and the axilla, where a sharper
/// edge pinches single elements; in CC a larger one would reach back to the chest wall and carry the force there.
constexpr double radius_cc = 3, radius_oblique = 15;
/// In CC the detector's edge lies across the patient's body, who turns by no more than this (degrees) towards the breast's side.
constexpr double most_turn_cc = 15;
/// Of skin on a smooth plate. Measured in living people: 0.46 ± 0.15 in the mean of five materials, 0.37 ± 0.09 on nylon, the
/// lowest of them (Zhang and Mak 1999); above 0.2 and typically 0.5 for dry skin (Derler and Gerhardt 2012). This is the
/// lower end, with which the plates still hold what the hand has pulled forwards.
constexpr double skin_friction = 0.3;
/// Percent; a smaller reduction is a fraction, not a percentage.
constexpr double least_reduction = 1;

std::optional<double> parse_angle(const char* option, const std::string& text, double most) {
  if (text == "auto") return std::nullopt;
  const std::optional<double> angle = number_in(text);
  if (angle && std::abs(*angle) <= most) return angle;
  throw input_error(option, " ", text, ": give 'auto' or degrees from ", -most, " to ", most);
}

ContactMethod method_of(const CompressionChoices& c, ContactMethod usual) {
  const bool lagrangian = c.contact == "al";
  if (lagrangian && c.contact_points == "surface") {
    throw input_error(
        "--contact-points surface with --contact al: the augmented Lagrangian has contact at "
        "nodes only");
  }
  if (lagrangian) return ContactMethod::augmented_lagrangian;
  if (c.contact_points.empty()) return usual;
  return c.contact_points == "surface" ? ContactMethod::surface : ContactMethod::active_set;
}

Positioning positioning_of(const CompressionChoices& c, Positioning usual) {
  if (c.positioning.empty()) return usual;
  return c.positioning == "lifted" ? Positioning::lifted : Positioning::hanging;
}

void check(const CompressionChoices& c) {
  if (c.reduction && *c.reduction < least_reduction) {
    throw input_error("--reduction ", *c.reduction, " percent is below ", least_reduction,
                      "; did you mean ", 100 * *c.reduction,
                      "? (for a smaller one give the gap in mm, --thickness)");
  }
  if (!c.image_edge.empty() && c.plates.standoff) {
    throw input_error("--image-edge with --standoff: both place the plates' edge; give only one");
  }
}

}  // namespace

double parse_detector(const std::string& text) {
  if (text == "raised") return std::numeric_limits<double>::infinity();
  if (text == "fixed") return 0;
  const std::optional<double> rise = number_in(text);
  if (rise && *rise >= 0) return *rise;
  throw input_error("--detector ", text, ": give 'raised', 'fixed' or a rise in mm, 0 or more");
}

double parse_image_edge(const std::string& text, View view, double muscle_mm) {
  constexpr double least = -50, most = 500;
  // Without muscle 0, not −0, which a report would show.
  if (text == "auto") return view == View::cc ? edge_cc : 0 - edge_in_muscle * muscle_mm;
  const std::optional<double> edge = number_in(text);
  if (edge && *edge >= least && *edge <= most) return *edge;
  throw input_error("--image-edge ", text, ": give 'auto' or mm from ", least, " to ", most);
}

std::optional<double> parse_turn(const std::string& text) {
  return parse_angle("--turn", text, 90);
}

std::optional<double> parse_lean(const std::string& text) {
  return parse_angle("--lean", text, 45);
}

std::optional<double> parse_bend(const std::string& text) {
  return parse_angle("--bend", text, 45);
}

std::vector<CompressionStop> CompressionChoices::stops() const {
  std::vector<CompressionStop> all;
  const auto add = [&](const std::optional<double>& value, StopAt at) {
    if (value) all.push_back({at, *value});
  };
  add(thickness, StopAt::thickness);
  add(reduction, StopAt::reduction);
  add(force, StopAt::force);
  add(pressure, StopAt::pressure);
  add(area, StopAt::area);
  return all;
}

// Without friction a breast that slides on the chest wall is squeezed out from between the plates.
Placement Placement::clinical(View view) {
  Placement placement;
  placement.edge_radius = view == View::cc ? radius_cc : radius_oblique;
  placement.turn_deg = placement.lean_deg = std::nullopt;
  if (view != View::ml) placement.bend_deg = std::nullopt;
  if (view == View::cc) placement.most_turn_deg = most_turn_cc;
  placement.method = ContactMethod::surface;
  placement.friction = skin_friction;
  placement.positioning = Positioning::lifted;
  placement.pull_N = 30;
  return placement;
}

bool CompressionOptions::follows_breast() const {
  return plates.image_edge && !plates.middle_at && std::isinf(plates.detector_rise) &&
         positioning == Positioning::lifted;
}

CompressionOptions compression_options(const CompressionChoices& c, const Vec3& gravity,
                                       const CompressedBody& body) {
  check(c);
  const bool by_image = !c.image_edge.empty() || (body.slides && !c.plates.standoff);
  CompressionOptions options;
  options.view = view_named(c.view);
  const Placement usual = by_image ? Placement::clinical(options.view) : Placement{};
  options.angle_deg = c.angle.value_or(view_angle_deg(options.view));
  options.gravity = gravity;
  options.plates = c.plates;
  if (by_image) {
    options.plates.image_edge = parse_image_edge(c.image_edge.empty() ? "auto" : c.image_edge,
                                                 options.view, body.muscle_mm);
    const bool automatic = (c.image_edge.empty() || c.image_edge == "auto") && !c.plates.edge_at;
    if (automatic && options.view == View::cc)
      options.plates.farthest_image_edge = farthest_edge_cc;
  }
  options.plates.detector_rise = parse_detector(c.detector);
  options.plates.edge_radius = c.edge_radius.value_or(usual.edge_radius);
  options.plates.turn_deg = c.turn.empty() ? usual.turn_deg : parse_turn(c.turn);
  options.plates.most_turn_deg = usual.most_turn_deg;
  options.plates.lean_deg = c.lean.empty() ? usual.lean_deg : parse_lean(c.lean);
  options.plates.bend_deg = c.bend.empty() ? usual.bend_deg : parse_bend(c.bend);
  options.method = method_of(c, usual.method);
  options.positioning = positioning_of(c, usual.positioning);
  const bool faces = options.method == ContactMethod::surface;
  options.friction = c.friction.value_or(faces ? usual.friction : 0);
  // Nothing else would hold a breast that was pulled.
  const bool held = faces && options.friction > 0 && options.positioning == Positioning::lifted;
  options.pull_N = c.pull.value_or(held ? usual.pull_N : 0);
  options.path.first_step = options.path.longest_step = c.plate_step.value_or(0);
  options.path.most_iterations = c.most_iterations;
  if (options.view != View::cc && options.friction > 0) options.path.slipping_part = slipping_part;
  options.stops = c.stops();
  return options;
}

}  // namespace breast
