// SPDX-License-Identifier: GPL-3.0-or-later
// identify: a patient's own stiffness from her breast in two postures.
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "identification/agreement.hpp"
#include "identification/comparison.hpp"
#include "identify_seen.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "material/material_set.hpp"
#include "mesh/element_order.hpp"
#include "solved_model.hpp"

using namespace breast;

namespace {

// Table of the parameters and, below it, of the combinations that the data determine.
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

std::string cell(double value) {
  return std::isfinite(value) ? format_fixed(value, 2) : "-";
}

// Table of fitted landmarks with all their quantities, and of other landmarks with their errors.
Table landmark_table(const Identified& found, const Comparison& compared) {
  Table table{{"landmark", "fitted", "moved_mm", "residual_mm", "left_out_mm", "observer_mm",
               "predicted_x_mm", "predicted_y_mm", "predicted_z_mm"},
              {}};
  for (const std::string& set : compared.sets) table.columns.push_back(set + "_mm");
  for (std::size_t i = 0; i < compared.landmarks.size(); ++i) {
    const ComparedLandmark& one = compared.landmarks[i];
    std::vector<std::string> row{one.name, one.fitted ? "yes" : "no", cell(one.moved)};
    if (one.fitted) {
      const LandmarkFit& fit = found.landmarks[i];
      for (const double value : {fit.residual, fit.left_out, fit.observer, fit.predicted.x(),
                                 fit.predicted.y(), fit.predicted.z()})
        row.push_back(cell(value));
    } else {
      row.insert(row.end(), {"-", cell(one.found), "-", "-", "-", "-"});
    }
    for (const double error : one.sets) row.push_back(cell(error));
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

void report_answer(const Identified& found, Report& report) {
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
  report.set("surface_points", found.surface_points);
  report.set("pairs", found.pairs);
  report.set("jacobians", found.fit.jacobians);
  report.set("converged", found.fit.converged);
  if (!found.refusals.empty()) report.set("refused", found.refusals);
}

// Reports the whole motion of the rib cage between the scans, and the part found from the chest
// walls.
void report_motion(const Identified& found, const std::optional<WallAlignment>& ribs,
                   Report& report) {
  const RigidMotion whole = ribs ? ribs->motion.after(found.motion) : found.motion;
  report.set("alignment/centre_mm", whole.centre);
  report.set("alignment/shift_mm", whole.shift);
  report.set("alignment/turn_deg", whole.turn);
  if (!ribs) return;
  report.set("alignment/walls/shift_mm", ribs->motion.shift);
  report.set("alignment/walls/turn_deg", ribs->motion.turn);
  report.set("alignment/walls/residual_mm", ribs->residual_mm);
  report.set("alignment/walls/left_out_percent", ribs->left_out_percent);
  report.set("alignment/walls/places", ribs->places);
  for (const std::string& words : ribs->words()) report.append("alignment/walls/known", words);
}

void report_comparison(const Comparison& compared, Report& report) {
  for (std::size_t s = 0; s < compared.sets.size(); ++s)
    if (!compared.refusals[s].empty())
      report.append("compared_without_body", compared.sets[s] + ": " + compared.refusals[s]);
  const Table summary = compared.summary();
  for (std::size_t row = 0; row < summary.rows.size(); ++row)
    if (summary.cell(row, "mean_mm") != "-")
      report.set("compared/" + summary.cell(row, "model") + "/mean_mm",
                 summary.number(row, "mean_mm"));
  report.set("compared_seconds", compared.solve_seconds);
}

IdentifyOptions options_of(const IdentifyChoices& c, const HexMesh& mesh, Run& run) {
  IdentifyOptions options;
  options.mechanics = model_for(c.mechanics, c.mesh, mesh, run);
  options.gravity = c.gravity.vector();
  options.imaged_gravity = posture_gravity(Posture::prone);
  options.parameters = c.names();
  options.prior = prior_from_name(c.prior);
  options.align = c.align;
  options.shift_mm = c.align_deviation[0], options.turn_deg = c.align_deviation[1];
  options.max_pairs = c.pairs;
  return options;
}

// The sets to compare, with their own settings and the same elements.
std::vector<ComparedSet> sets_of(const IdentifyChoices& c, Element element) {
  std::vector<ComparedSet> sets;
  for (const std::string& name : c.compare) {
    MechanicsTexts own;
    own.materials = name, own.element = element_name(element);
    sets.push_back({name, mechanics_options(own)});
  }
  return sets;
}

void tell_ribs(const WallAlignment& ribs, Run& run) {
  run.warn(message("rib cages registered by their chest walls: residual ",
                   format_fixed(ribs.residual_mm, 2), " mm at ", ribs.places, " places, ",
                   format_fixed(ribs.left_out_percent, 0), " % left out"));
  for (const std::string& words : ribs.words())
    if (words.find("not determined") != std::string::npos) run.warn(words);
}

void run_identify(const IdentifyChoices& c, Run& run) {
  HexMesh mesh = read_mesh(c.mesh, {.geometry = true});
  IdentifyOptions options = options_of(c, mesh, run);
  const std::vector<ComparedSet> sets = sets_of(c, options.mechanics.element);
  Pairs pairs = pairs_of("identify", run);
  const SecondScan scan = read_second_scan(c, mesh, pairs);
  if (scan.ribs) {
    options.align = true;
    options.motion_covariance = scan.ribs->covariance;
    options.gravity = scan.ribs->motion.rotation().transpose() * options.gravity;
    tell_ribs(*scan.ribs, run);
  }
  if (options.mechanics.element == Element::q2p1) mesh = raise_order(mesh);
  Identified found = identify(mesh, scan.seen, options, run.progress());
  check_agreement(mesh, scan.seen, found);
  if (!found.fit.converged && !found.fit.at_limit) {
    throw not_converged_error("not converged after ", found.pairs,
                              " solves of both postures; give more with --max-pairs");
  }
  for (const std::string& doubt : doubts_of(found)) run.warn(doubt);
  const Comparison compared =
      compare_sets(mesh, scan.seen, scan.judged, found, sets, options, run.progress());
  report_answer(found, run.report());
  if (options.align) report_motion(found, scan.ribs, run.report());
  report_comparison(compared, run.report());
  run.report().set("side", side_name(mesh.side));
  run.report().set("elements", mesh.elements());
  run.report().set("status", "converged");
  run.print(answer_of(found));
  if (!compared.landmarks.empty() && (!sets.empty() || !scan.judged.empty()))
    run.print("\n" + compared.summary().text());
  if (!c.table.empty()) write_table(c.table, landmark_table(found, compared));
  if (!c.seen.empty()) {
    TriMesh seen = seen_beside(scan, found);
    seen.history = run.history({{c.mesh, mesh.content_sha256, &mesh.history},
                                {c.surface, scan.surface.content_sha256, &scan.surface.history}});
    write_surface(c.seen, seen);
  }
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
