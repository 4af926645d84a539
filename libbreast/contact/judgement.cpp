// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/judgement.hpp"

#include <algorithm>
#include <cmath>

#include "contact/grip.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

/// A range of clinical practice and its source.
struct Range {
  const char* id;
  const char* name;
  const char* unit;
  double low, high;
  const char* source;
  double rounding = 0;  ///< fraction of the bounds by which a value may lie outside
};
constexpr Range thickness_range{"thickness", "thickness", "mm",
                                30,          90,          "59 +-16 mm, 2640 mammograms"};
constexpr Range cc_volume_range{"volume_in_image",
                                "share of the breast in front of the image's edge",
                                "%",
                                55,
                                100,
                                "upper and posterior tissue is missed in CC"};
constexpr Range oblique_volume_range{
    "volume_in_image",
    "share of the breast in front of the image's edge",
    "%",
    90,
    100,
    "the muscle reaches the nipple's line in more than 80 % of MLO views"};
constexpr Range jacobian_range{"scaled_jacobian",
                               "least scaled Jacobian of the elements",
                               "",
                               0.1,
                               1,
                               "flatter elements are not to be trusted"};

/// The plates are called unbalanced if one of them transfers more than this fraction of the smaller
/// plate's force, and more than this force, to wall and cut.
constexpr double wall_part = 0.25, wall_least_N = 10;
/// If more than this fraction of the force acts on the rounded edge, the flat part hardly
/// compresses.
constexpr double most_on_edge = 0.5;
constexpr double deepest_penetration_mm = 0.05, largest_volume_error = 1e-6;
/// Self-contact and penetration of the chest wall below these values are not resolved by the mesh.
constexpr double largest_self_contact_cm2 = 0.5, deepest_in_thorax_mm = 1;
/// Relative error of the friction bounds above which the forces are visibly affected.
constexpr double largest_friction_lag = 0.02;
/// The search for a force ends within half a per cent of it: a default target of 50 N that ends at
/// 49.8 N is no doubt.
constexpr double force_rounding = 0.005;
/// A target passed by this fraction is still met as well as a technologist meets it.
constexpr double little_past = 0.05;

double shown(double value) {
  const double size = std::abs(value);
  return size >= 10  ? std::round(value)
         : size >= 1 ? std::round(10 * value) / 10
                     : std::round(1000 * value) / 1000;
}

Judgement judge(const Range& range, double value) {
  // A value that is not a number is never within the range.
  const double least = (1 - range.rounding) * range.low, most = (1 + range.rounding) * range.high;
  const bool low = value < least, within = value >= least && value <= most;
  const std::string verdict = within ? "within" : low ? "below" : "above";
  return {std::string(range.id) + "_" + verdict,
          message(range.name, " ", shown(value), " ", range.unit, " is ", verdict, " the range of ",
                  range.low, "-", range.high, " ", range.unit, " (", range.source, ")"),
          !within, true};
}

/// Force and mean pressure of a plate.
void judge_plate(const PlateRecord& plate, std::vector<Judgement>& list) {
  const std::string force_id = plate.name + "_force", force_name = plate.name + " force";
  Judgement force =
      judge({force_id.c_str(), force_name.c_str(), "N", 50, 180,
             "proposed end points 50-130 N, PMC3615392; Dutch protocol 180 N, Radiology 181:355",
             force_rounding},
            plate.force_N);
  if (force.id.ends_with("below")) {
    force.sentence +=
        "; a fixed rigid chest wall and low moduli give too small a force: most of the "
        "machine's force acts on the stiff tissue at the chest wall, which the model omits";
  } else if (force.id.ends_with("above")) {
    force.sentence +=
        "; no patient would tolerate it: the laws stiffen too much in compression, or the plate "
        "edge is too close to the fixed chest wall";
  }
  list.push_back(force);
  const std::string id = plate.name + "_pressure", name = plate.name + " mean pressure";
  list.push_back(judge({id.c_str(), name.c_str(), "kPa", 5, 30,
                        "at 180 N 21 +-54 % in CC, 14 +-32 % in MLO, de Groot 2013"},
                       plate.mean_kPa));
}

/// Pressure sensors under the plate read far less on the breast itself than force divided by area.
Judgement against_sensors(const ContactRecord& contact, const PressedState& state) {
  const double on_edge = state.places.empty() ? 0 : state.places.front().edge_part;
  const bool cc = contact.view == View::cc;
  return {"pressure_against_sensors",
          message("sensors under a rigid paddle read ", cc ? 2.3 : 0.5, " kPa on the breast in ",
                  cc ? "CC" : "MLO", ", where only ", cc ? 22 : 14,
                  " % of the force acts (10.1177/0284185120976925): here the mean is ",
                  shown(contact.plates.front().mean_kPa), " kPa with ", shown(100 * (1 - on_edge)),
                  " % of the force, because the model has no stiff tissue behind the edge"),
          false};
}

Judgement judge_penetration(const ContactRecord& contact) {
  double worst = 0;
  for (const PlateRecord& plate : contact.plates) worst = std::max(worst, plate.worst_gap_mm);
  const bool good = worst <= deepest_penetration_mm;
  return {good ? "penetration_within" : "penetration_above",
          message("worst penetration ", worst, " mm is ", good ? "below " : "not below ",
                  deepest_penetration_mm, " mm"),
          !good};
}

Judgement judge_volume(double error) {
  const bool good = error <= largest_volume_error;
  return {good ? "volume_kept" : "volume_changes",
          message("worst volume change of an element ", error, good ? " is" : " is not", " below ",
                  largest_volume_error, good ? "" : " (a finite --bulk-ratio lets volumes change)"),
          !good};
}

/// The model does not prevent the breast from penetrating itself or the chest wall beside its base.
void judge_self_contact(const SelfContact& self, std::vector<Judgement>& list) {
  if (self.itself_cm2 > largest_self_contact_cm2) {
    list.push_back({"touches_itself",
                    message("the breast touches itself over ", shown(self.itself_cm2),
                            " cm2, which the model does not prevent: the shape is wrong there"),
                    true});
  }
  if (self.into_thorax_mm > deepest_in_thorax_mm) {
    list.push_back({"touches_thorax",
                    message("skin lies ", shown(self.into_thorax_mm),
                            " mm deep in the chest wall, which the model does not prevent: the "
                            "shape is wrong there"),
                    true});
  }
}

/// The option that sets the distance of the plates from the wall.
std::string placing_option(const ContactRecord& contact) {
  return contact.ends_image ? "--image-edge" : "--standoff";
}

/// A thickness between the flat parts means little if these carry little of the force.
Judgement judge_edge(const PlateRecord& plate, const PressedPlace& where) {
  const bool much = !(where.edge_part <= most_on_edge);
  return {plate.name + (much ? "_presses_with_its_edge" : "_presses_with_its_flat"),
          message("the rounded edge carries ", shown(100 * where.edge_part), " % of the ",
                  plate.name, "'s force",
                  much ? ": the flat part covers too little of the breast; try a smaller --standoff"
                       : ""),
          much};
}

std::string place(const PressedPlace& where) {
  return message("(", std::round(where.peak_at.x()), ", ", std::round(where.peak_at.y()), ", ",
                 std::round(where.peak_at.z()), ") mm, ", shown(where.peak_to_wall_mm),
                 " mm from the chest wall or cut");
}

/// The forces of the plates differ by the weight of the breast and the reaction of the wall. A
/// reaction beyond the weight means that a plate presses on wall or cut through the breast.
Judgement judge_balance(const ContactRecord& contact, const PressedState& state) {
  const PlateRecord &paddle = contact.plates[0], &detector = contact.plates[1];
  const double weight = state.weight_N.dot(state.beam);
  const double wall = state.wall_reaction_N.dot(state.beam);
  const double smaller = std::min(paddle.force_N, detector.force_N);
  const double allowed = std::max(wall_least_N, wall_part * smaller) + std::abs(weight);
  const std::string forces =
      message("paddle ", shown(paddle.force_N), " N, detector ", shown(detector.force_N),
              " N; along the beam the breast weighs ", shown(weight),
              " N and chest wall and cut hold it with ", shown(wall), " N");
  if (std::abs(wall) <= allowed) return {"plates_balanced", "plates balanced: " + forces, false};
  const std::size_t k = paddle.force_N > detector.force_N ? 0 : 1;
  std::string sentence =
      "plates not balanced: " + forces + ", more than a quarter of the smaller " + "plate's: the " +
      contact.plates[k].name + " presses on the chest wall or the cut, not on the breast alone";
  if (k < state.places.size() && state.places[k].peak_to_wall_mm >= 0) {
    sentence += message("; its highest pressure, ", shown(contact.plates[k].peak_kPa),
                        " kPa, is at ", place(state.places[k]));
  }
  return {"plates_unbalanced",
          sentence + "; try a larger " + placing_option(contact) + " or --edge-radius", true};
}

}  // namespace

std::vector<Judgement> judge_compression(const ContactRecord& contact, const PressedState& state) {
  std::vector<Judgement> list;
  for (const PlateRecord& plate : contact.plates) judge_plate(plate, list);
  list.push_back(against_sensors(contact, state));
  list.push_back(judge(thickness_range, contact.thickness_mm));
  if (contact.ends_image) {
    list.push_back(judge(contact.view == View::cc ? cc_volume_range : oblique_volume_range,
                         state.volume_in_front_percent));
    list.push_back(judge(jacobian_range, state.min_scaled_jacobian));
  }
  list.push_back(judge_penetration(contact));
  list.push_back(judge_volume(state.max_volume_error));
  if (contact.ends_image) {
    for (Judgement& line : judge_grip(contact, state)) list.push_back(std::move(line));
  } else {
    for (std::size_t k = 0; k < contact.plates.size() && k < state.places.size(); ++k) {
      list.push_back(judge_edge(contact.plates[k], state.places[k]));
    }
  }
  list.push_back(judge_balance(contact, state));
  judge_self_contact(state.self, list);
  return list;
}

std::optional<Judgement> judge_target(const CompressionTarget& met, double reached) {
  constexpr double on_target = 0.02, far_off = 0.25;
  const double off = std::abs(reached / met.value - 1);
  if (!(off > on_target)) return std::nullopt;
  return Judgement{"off_target",
                   message("the ", target_name(met.kind), " ends at ", shown(reached), ", ",
                           shown(100 * off), " % from its target of ", shown(met.value),
                           ": the contact area changes by parts of a face"),
                   off > far_off};
}

std::vector<Judgement> judge_path(const PathResult& path, bool stable) {
  std::vector<Judgement> list;
  if (path.first_indefinite_thickness) {
    list.push_back({"slips_or_buckles",
                    message("the tangent was indefinite in ", path.indefinite,
                            " iterations, first at thickness ", *path.first_indefinite_thickness,
                            " mm: the breast slips or buckles there",
                            stable ? "; the final state is stable" : ""),
                    !stable});
  }
  if (path.jump) {
    list.push_back(
        {"jump_at_target",
         message("snap-through at the target: between plate positions 0.1 micrometre "
                 "apart the ",
                 target_name(path.met.kind), " goes from ", path.jump->first, " to ",
                 path.jump->second, ", past ", path.met.value, "; the closer one is the result"),
         true});
  }
  if (path.passed_by) {
    list.push_back({"ends_past_target",
                    message("the ", target_name(path.met.kind), " is ", shown(*path.passed_by),
                            ", beyond its target of ", shown(path.met.value),
                            ": the hand that lifts the breast had not let go earlier"),
                    *path.passed_by > (1 + little_past) * path.met.value});
  }
  const double lag = path.final_step.friction_lag;
  if (lag > largest_friction_lag) {
    list.push_back({"friction_lags",
                    message("friction's bounds differ by ", shown(100 * lag),
                            " % from its coefficient times the pressure: forces near the "
                            "plates' edge are uncertain by as much"),
                    true});
  }
  return list;
}

}  // namespace breast
