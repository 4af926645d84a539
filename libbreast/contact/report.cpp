// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>

#include "contact/compression.hpp"
#include "core/error.hpp"
#include "mechanics/mechanics.hpp"

namespace breast {

void write_report(const CompressionResult& summary, const HexMesh& mesh,
                  const MechanicsOptions& mechanics, Report& report) {
  write_report(static_cast<const Equilibrium&>(summary), mesh, mechanics, report);
  report.set("indefinite_iterations", summary.path.indefinite);
  report.set("failed_steps", summary.path.failures);
  report.set("placements", summary.placements);
  if (summary.path.reached()) report.set("ended_by", target_name(summary.path.met.kind));
  if (!summary.contact) return;
  const ContactRecord& contact = *summary.contact;
  report.set("thickness_mm", contact.thickness_mm);
  report.set("initial_thickness_mm", contact.initial_thickness_mm);
  report.set("reduction_percent", contact.reduction_percent);
  report.set("standoff_mm", contact.standoff_mm);
  const PlateRecord& detector = contact.plates[1];
  report.set("edge_at_mm", detector.origin.dot(detector.anterior));
  report.set("turn_deg", contact.turn_deg);
  report.set("lean_deg", contact.lean_deg);
  report.set("bend_deg", contact.bend_deg);
  report.set("contact_points", contact.surface_stiffness > 0 ? "surface" : "nodes");
  if (contact.surface_stiffness > 0) {
    report.set("surface_stiffness_Pa_per_mm", contact.surface_stiffness);
  }
  report.set("middle_at_mm", summary.plates.middle());
  report.set("detector_raised_mm", summary.plates.underside - summary.plates.detector.level);
  report.set("edge_radius_mm", contact.plates[0].edge_radius);
  report.set("view", view_name(contact.view));
  report.set("angle_deg", contact.angle_deg);
  double worst = 0;
  for (std::size_t k = 0; k < contact.plates.size(); ++k) {
    const PlateRecord& plate = contact.plates[k];
    const std::string key = "plates/" + plate.name + "/";
    const PressedPlace& place = summary.places.at(k);
    if (place.peak_to_wall_mm >= 0) {
      report.set(key + "peak_at", place.peak_at);
      report.set(key + "peak_to_wall_mm", place.peak_to_wall_mm);
      report.set(key + "edge_force_percent", 100 * place.edge_part);
    }
    report.set(key + "force_N", plate.force_N);
    report.set(key + "force_behind_edge_N", place.behind_edge_N);
    report.set(key + "force_first_20mm_N", place.first_20mm_N);
    report.set(key + "force_beyond_20mm_N", place.beyond_20mm_N);
    report.set(key + "area_cm2", plate.area_cm2);
    report.set(key + "mean_pressure_kPa", plate.mean_kPa);
    report.set(key + "peak_pressure_kPa", plate.peak_kPa);
    report.set(key + "worst_gap_mm", plate.worst_gap_mm);
    worst = std::max(worst, plate.worst_gap_mm);
  }
  report.set("force_N", contact.plates[0].force_N);
  report.set("detector_force_N", contact.plates[1].force_N);
  report.set("pressure_kPa", contact.plates[0].mean_kPa);
  report.set("area_cm2", contact.plates[0].area_cm2);
  report.set("worst_gap_mm", worst);
  report.set("worst_nodal_gap_mm", summary.path.final_step.worst_penetration);
  report.set("force_balance", summary.force_balance);
  report.set("wall_reaction_N", summary.wall_reaction_N);
  report.set("weight_N", summary.weight_N);
  report.set("thrust_into_wall_N", summary.wall_reaction_N.dot(summary.plates.paddle.anterior));
  report.set("touches_itself_cm2", summary.self_contact.itself_cm2);
  report.set("into_thorax_mm", summary.self_contact.into_thorax_mm);
  report.set("coverage/volume_percent", summary.coverage.volume);
  report.set("coverage/projected_cm2", summary.projected_cm2);
  if (summary.projected_cm2 > 0) {
    report.set("coverage/contact_percent_of_projected",
               100 * contact.plates[0].area_cm2 / summary.projected_cm2);
  }
  if (summary.coverage.fibroglandular) {
    report.set("coverage/fibroglandular_percent", *summary.coverage.fibroglandular);
  }
  for (const PositioningStage& stage : summary.stages) {
    const std::string key = "stages/" + stage.name + "/";
    report.set(key + "volume_in_front_percent", stage.volume_in_front_percent);
    report.set(key + "past_edge_mm", stage.past_edge_mm);
  }
  for (const Landmark& landmark : mesh.landmarks) {
    const Vec3 at = landmark_position(mesh, summary.points, landmark);
    const Plate& paddle = summary.plates.paddle;
    const double in_front = paddle.in_front(at);
    report.set("coverage/" + landmark.name + "_in_front_mm", in_front);
    if (const auto muscle = muscle_in_front(mesh, summary.points, paddle, at))
      report.set("coverage/" + landmark.name + "_to_muscle_mm", in_front - *muscle);
  }
  for (const auto& [tissue, range] : summary.strains) {
    const std::string key = "strain/" + std::string(tissue_name(tissue)) + "/";
    report.set(key + "min_stretch", range.min_stretch);
    report.set(key + "max_stretch", range.max_stretch);
    report.set(key + "min_det_F", range.min_det_F);
    report.set(key + "max_det_F", range.max_det_F);
  }
  report.set("profile/depth_mm", summary.profile_depth_mm);
  report.set("profile/thickness_mm", summary.profile_thickness_mm);
  report.set("path/thickness_mm", contact.path_thickness_mm);
  report.set("path/force_N", contact.path_force_N);
  report.set("path/detector_force_N", contact.path_detector_N);
  for (const Judgement& line : summary.judgement) {
    report.set("judgement/" + line.id, line.sentence);
    if (line.doubtful) report.append("doubt_ids", line.id);
  }
}

namespace {

/// Three digits suffice here; the report has all of them.
std::string brief(const Report& report, const std::string& key) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", report.number(key));
  return text;
}

}  // namespace

std::vector<std::string> plate_lines(const Report& report) {
  if (!report.contains("thickness_mm")) return {};
  std::string line = message("thickness ", brief(report, "thickness_mm"), " of ",
                             brief(report, "initial_thickness_mm"), " mm (",
                             brief(report, "reduction_percent"), " % less)");
  for (const char* name : {"paddle", "detector"}) {
    const std::string key = std::string("plates/") + name + "/";
    line += message("; ", name, " ", brief(report, key + "force_N"), " N on ",
                    brief(report, key + "area_cm2"), " cm2, mean ",
                    brief(report, key + "mean_pressure_kPa"), " kPa, peak ",
                    brief(report, key + "peak_pressure_kPa"), " kPa");
  }
  return {line + "; deepest penetration " + brief(report, "worst_gap_mm") + " mm"};
}

}  // namespace breast
