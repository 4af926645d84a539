// SPDX-License-Identifier: GPL-3.0-or-later
// Force of both plates against thickness on the way to the compressed shape.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/table.hpp"
#include "figures/chart.hpp"
#include "figures/colour_scale.hpp"
#include "figures/parts.hpp"

namespace breast {

namespace {

constexpr double clinical_low_N = 50, clinical_high_N = 180;
constexpr double least_shown_N = 0.1;
constexpr std::array<Colour, 3> path_colours = {
    {{0.12, 0.35, 0.70}, {0.80, 0.30, 0.12}, {0.15, 0.55, 0.35}}};

std::vector<Vec2> path_of(const ContactRecord& contact, const std::vector<double>& force) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < force.size(); ++i) {
    points.emplace_back(contact.path_thickness_mm[i], force[i]);
  }
  return points;
}

void add_paths(Panel& panel, const std::vector<const HexMesh*>& meshes, const Axis& thickness,
               const Axis& force, const std::string& caption) {
  Chart chart(panel, thickness, force);
  chart.band(clinical_low_N, clinical_high_N, {0.88, 0.95, 0.88}, "");
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const ContactRecord& contact = *meshes[k]->contact;
    const Colour& colour = path_colours[k % path_colours.size()];
    chart.curve(path_of(contact, contact.path_force_N), colour, 3, false);
    chart.curve(path_of(contact, contact.path_detector_N), colour, 2, true);
    const std::string view =
        view_name(contact.view) + ", reduction " + format_fixed(contact.reduction_percent, 0) + " %, ";
    chart.legend(view + "paddle " + format_fixed(contact.plates[0].force_N, 0) + " N", colour,
                 false);
    if (!contact.path_detector_N.empty()) {
      chart.legend(view + "detector " + format_fixed(contact.plates[1].force_N, 0) + " N", colour,
                   true);
    }
  }
  chart.legend("green: 50 to 180 N, the clinical range", {0.6, 0.8, 0.6}, false);
  chart.frame();
  panel.caption(caption);
}

}  // namespace

void draw_force_thickness(Picture& picture, const FigureInput& input) {
  std::vector<const HexMesh*> meshes;
  double thickest = 0, thinnest = 1e9, strongest = 0;
  for (const auto& named : input.meshes) {
    if (!named.mesh.contact || named.mesh.contact->path_thickness_mm.empty()) continue;
    if (named.mesh.contact->plates.size() != 2) continue;
    const ContactRecord& contact = *named.mesh.contact;
    meshes.push_back(&named.mesh);
    for (const double t : contact.path_thickness_mm) {
      thickest = std::max(thickest, t);
      thinnest = std::min(thinnest, t);
    }
    for (const auto* forces : {&contact.path_force_N, &contact.path_detector_N}) {
      for (const double f : *forces) strongest = std::max(strongest, f);
    }
  }
  need(!meshes.empty(), "force-thickness", "a compressed .vtkhdf with its path");
  const double step = 10;
  const Axis thickness{"thickness between the flats (mm)", step * std::ceil(thickest / step),
                       step * std::floor(thinnest / step)};
  const double high = std::max(strongest, clinical_high_N) * 1.15;
  add_paths(picture.panel(0, 0, 0.5, 1), meshes, thickness, {"force (N)", 0, high},
            "(a) force of each plate; squares: solved plate positions");
  add_paths(picture.panel(0.5, 0, 1, 1), meshes, thickness,
            {"force (N)", least_shown_N, round_up(high), true}, "(b) the same, logarithmic");
}

}  // namespace breast
