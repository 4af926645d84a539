// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/grip.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double usual_force_N = 110, least_force_N = 50, least_thickness_mm = 35;
/// Of a small breast: 40 kPa over the projection of its stress-free shape. Pulled and flattened, it touches the plates over
/// more than that, so that the mean pressure stays below 30 kPa, the most that women bore in measured curves.
constexpr double force_N_per_cm2 = 4;

constexpr double least_pressed = 25, least_contact_percent = 40;
/// Share of the force on a rounded edge, percent, from which the flat part does not hold the breast.
constexpr double most_edge_percent = 40;

}  // namespace

std::vector<CompressionStop> clinical_stops(double projected_cm2) {
  const double force = std::clamp(force_N_per_cm2 * projected_cm2, least_force_N, usual_force_N);
  return {{StopAt::force, force}, {StopAt::thickness, least_thickness_mm}};
}

double least_pressed_cm2(double projected_cm2) {
  return std::max(least_pressed, least_contact_percent / 100 * projected_cm2);
}

std::vector<Judgement> judge_grip(const ContactRecord& contact, const PressedState& state) {
  std::vector<Judgement> missing;
  const double touched = 100 * contact.plates[0].area_cm2 / state.projected_cm2;
  if (!(touched >= least_contact_percent)) {
    missing.push_back({"contact_too_small",
                       message("the paddle touches only ", std::round(touched),
                               " % of the breast's projection (at least ", least_contact_percent,
                               " % are needed)"),
                       true, true});
  }
  for (std::size_t k = 0; k < state.places.size(); ++k) {
    const double on_edge = 100 * state.places[k].edge_part;
    if (on_edge < most_edge_percent) continue;
    missing.push_back({"edge_carries_force",
                       message("the rounded edge carries ", std::round(on_edge), " % of the ",
                               contact.plates[k].name, "'s force (less than ", most_edge_percent,
                               " % are allowed): the flat part does not hold the breast"),
                       true, true});
  }
  if (!missing.empty()) return missing;
  return {{"gripped",
           message("the plates grip the breast: the paddle touches ",
                   std::round(contact.plates[0].area_cm2), " cm2 of skin"),
           false}};
}

}  // namespace breast
