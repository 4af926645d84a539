// SPDX-License-Identifier: GPL-3.0-or-later
// identify: a patient's own stiffness from her breast in two postures.
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "identification/agreement.hpp"
#include "identification/landmark_pairs.hpp"
#include "identification/seen_surface.hpp"
#include "identify_options.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "material/material_table.hpp"
#include "mesh/element_order.hpp"
#include "views/view.hpp"

using namespace breast;

namespace {

std::vector<LandmarkPair> pairs_of(const IdentifyChoices& c, const HexMesh& mesh) {
  std::vector<LandmarkPair> pairs;
  if (!c.landmarks.empty()) pairs = landmark_pairs(read_table(c.landmarks), mesh.side, c.observer);
  if (c.nipple.empty()) return pairs;
  const Landmark* nipple = mesh.landmark("nipple");
  if (nipple == nullptr) throw input_error(c.mesh.string(), ": it has no landmark 'nipple'");
  const std::string name = pairs.empty() ? "nipple" : "nipple (--nipple)";
  pairs.push_back({name, nipple->imaged, Vec3(c.nipple[0], c.nipple[1], c.nipple[2]), c.observer});
  return pairs;
}

std::vector<SeenForce> forces_of(const Table& table) {
  std::vector<SeenForce> forces;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    SeenForce seen{table.number(row, "thickness_mm"), table.number(row, "force_N"), 0};
    seen.deviation = table.has("sd_N") ? table.number(row, "sd_N") : 0.1 * seen.force + 0.5;
    if (!(seen.thickness > 0 && seen.force > 0 && seen.deviation > 0)) {
      throw input_error(table.name, ", row ", row + 1,
                        ": thickness_mm, force_N and sd_N must be above 0");
    }
    forces.push_back(seen);
  }
  if (forces.empty()) throw input_error(table.name, ": no row");
  return forces;
}

Observations observations(const IdentifyChoices& c, const HexMesh& mesh) {
  Observations seen;
  const std::vector<LandmarkPair> pairs = pairs_of(c, mesh);
  const std::string where = c.landmarks.empty() ? "--nipple" : c.landmarks.string();
  if (!pairs.empty()) seen.points = seen_points(mesh, pairs, c.outside, where);
  if (!c.surface.empty())
    seen.surface = seen_surface(read_surface(c.surface), c.surface_error, c.surface.string());
  if (!c.forces.empty()) seen.forces = forces_of(read_table(c.forces));
  seen.press.view = view_named(c.view);
  seen.press.angle_deg = view_angle_deg(seen.press.view);
  seen.press.plates.standoff = c.standoff;
  seen.press.plates.edge_radius = c.edge_radius;
  return seen;
}

// The parameters and, below them, what is known of their combinations.
std::string answer_of(const Identified& found) {
  Table table{{"parameter", "factor", "ln_sd", "prior_ln_sd", "from_data_percent"}, {}};
  for (std::size_t k = 0; k < found.names.size(); ++k) {
    const double prior = std::sqrt(found.prior(Eigen::Index(k), Eigen::Index(k))),
                 sd = found.ln_sd(k);
    table.rows.push_back({found.names[k], format_fixed(found.factor(k), 3), format_fixed(sd, 3),
                          format_fixed(prior, 3),
                          format_fixed(100 * (1 - sd * sd / (prior * prior)), 1)});
  }
  Table directions{{"ln_sd", "from_data_percent", "direction"}, {}};
  for (const KnownDirection& one : found.directions) {
    directions.rows.push_back(
        {format_fixed(one.deviation, 3), format_fixed(100 * one.from_data(), 1), one.words});
  }
  return table.text() + "\n" + directions.text();
}

Table landmark_table(const Identified& found) {
  Table table{{"landmark", "residual_mm", "left_out_mm", "observer_mm", "predicted_x_mm",
               "predicted_y_mm", "predicted_z_mm"},
              {}};
  for (const LandmarkFit& one : found.landmarks) {
    std::vector<std::string> row{one.name};
    for (const double value : {one.residual, one.left_out, one.observer, one.predicted.x(),
                               one.predicted.y(), one.predicted.z()})
      row.push_back(format_fixed(value, 2));
    table.rows.push_back(row);
  }
  return table;
}

void report_landmarks(const Identified& found, Report& report) {
  if (found.landmarks.empty()) return;
  double residual = 0, left_out = 0;
  for (const LandmarkFit& one : found.landmarks) {
    report.set("landmarks/" + one.name + "/residual_mm", one.residual);
    report.set("landmarks/" + one.name + "/left_out_mm", one.left_out);
    report.set("landmarks/" + one.name + "/observer_mm", one.observer);
    residual += one.residual / double(found.landmarks.size());
    left_out += one.left_out / double(found.landmarks.size());
  }
  report.set("residual_mean_mm", residual);
  report.set("left_out_mean_mm", left_out);
}

void report_answer(const Identified& found, bool aligned, Report& report) {
  for (std::size_t k = 0; k < found.names.size(); ++k) {
    report.set("parameters/" + found.names[k] + "/factor", found.factor(k));
    report.set("parameters/" + found.names[k] + "/ln_sd", found.ln_sd(k));
  }
  for (const KnownDirection& one : found.directions) report.append("known", one.words);
  report_landmarks(found, report);
  report.set("decided_by_data", found.decided);
  report.set("misfit/chi_squared", found.misfit.chi_squared);
  report.set("misfit/data", found.misfit.freedom);
  report.set("misfit/probability", found.misfit.probability);
  report.set("misfit/discount", found.discount);
  if (aligned) {
    report.set("alignment/centre_mm", found.motion.centre);
    report.set("alignment/shift_mm", found.motion.shift);
    report.set("alignment/turn_deg", found.motion.turn);
  }
  report.set("surface_points", found.surface_points);
  report.set("pairs", found.pairs);
  report.set("jacobians", found.fit.jacobians);
  report.set("converged", found.fit.converged);
  if (!found.refusals.empty()) report.set("refused", found.refusals);
}

void run_identify(const IdentifyChoices& c, Run& run) {
  HexMesh mesh = read_mesh(c.mesh, {.geometry = true});
  IdentifyOptions options;
  options.mechanics = mechanics_options(c.mechanics);
  options.gravity = c.gravity.vector();
  options.imaged_gravity = posture_gravity(Posture::prone);
  options.parameters = c.names();
  options.prior = prior_from_name(c.prior);
  options.align = c.align;
  options.shift_mm = c.align_deviation[0], options.turn_deg = c.align_deviation[1];
  options.max_pairs = c.pairs;
  const Observations seen = observations(c, mesh);
  if (options.mechanics.element == Element::q2p1) mesh = raise_order(mesh);
  Identified found = identify(mesh, seen, options, run.progress());
  check_agreement(mesh, seen, found);
  if (!found.fit.converged && !found.fit.at_limit) {
    throw not_converged_error("not settled after ", found.pairs,
                              " solves of both postures; give more with --max-pairs");
  }
  for (const std::string& doubt : doubts_of(found)) run.warn(doubt);
  report_answer(found, c.align, run.report());
  run.report().set("side", side_name(mesh.side));
  run.report().set("elements", mesh.elements());
  run.report().set("status", "converged");
  run.print(answer_of(found));
  if (!c.table.empty()) write_table(c.table, landmark_table(found));
  if (!c.second.empty()) {
    found.second.history = run.history({{c.mesh, mesh.content_sha256, &mesh.history}});
    found.second.wall_seconds = run.seconds();
    write_mesh(c.second, found.second);
  }
  write_table(c.set, material_table(found.materials));
}

}  // namespace

int main(int argc, char** argv) {
  IdentifyChoices c;
  Tool tool("identify", "a patient's own stiffness from her breast in two postures");
  declare_identify(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_identify(c, run); });
}
