// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of a mechanics report (docs/file-formats.md).
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/blas.hpp"
#include "core/units.hpp"
#include "material/stability.hpp"
#include "mechanics/mechanics.hpp"
#include "mesh/quality.hpp"

namespace breast {

namespace {

void write_landmarks(const HexMesh& mesh, const std::vector<Vec3>& points, Report& report) {
  for (const Landmark& landmark : mesh.landmarks) {
    const std::string key = "landmarks/" + landmark.name + "/";
    const Vec3 imaged = landmark_position(mesh, mesh.imaged, landmark);
    const Vec3 position = landmark_position(mesh, points, landmark);
    report.set(key + "imaged", imaged);
    report.set(key + "position", position);
    report.set(key + "displacement_from_scan_mm", Vec3(position - imaged));
    report.set(key + "distance_mm", (position - imaged).norm());
  }
}

// Law, small-strain modulus and gravity number ρgL/μ of every tissue present, where L is the cube
// root of the volume.
void write_materials(const HexMesh& mesh, const MechanicsOptions& options, Report& report) {
  const std::vector<double> volumes = element_volumes(mesh, mesh.imaged);
  std::array<double, n_tissues> volume{};
  double total = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    volume[std::size_t(mesh.tissue[e])] += volumes[e];
    total += volumes[e];
  }
  if (mesh.skin_model == SkinModel::membrane) volume[std::size_t(Tissue::skin)] = 1e-300;
  report.set("materials/name", options.materials.name);
  for (int t = 0; t < n_tissues; ++t) {
    if (!(volume[t] > 0)) continue;
    const Law& law = options.materials.laws[t];
    const std::string tissue(tissue_name(Tissue(t))), key = "materials/" + tissue + "/";
    report.set(key + "law", law.describe());
    report.set(key + "shear_modulus_Pa", law.shear_modulus());
    report.set(key + "ellipticity_margin", ellipticity_margin(law).value);
    report.set(key + "gravity_number", options.materials.density[t] * gravity_mm_s2 *
                                           std::cbrt(total) / law.shear_modulus());
    if (volume[t] > 1e-6) report.set("volumes_ml/" + tissue, volume[t] / mm3_per_ml);
  }
}

// Wrinkling of a membrane skin, oscillation of the pressures.
void write_field_checks(const SolveSummary& summary, Report& report) {
  for (const auto& [tissue, quality] : summary.pressure_quality) {
    const std::string key = "pressures/" + std::string(tissue_name(tissue)) + "/";
    report.set(key + "checkerboard", quality.checkerboard);
    report.set(key + "filtered_min_Pa", quality.least);
    report.set(key + "filtered_max_Pa", quality.greatest);
  }
  const SkinState& skin = summary.skin;
  if (skin.faces == 0) return;
  report.set("skin/faces", skin.faces);
  report.set("skin/compressed_faces", skin.compressed);
  report.set("skin/compressed_area_percent", 100 * skin.compressed_share);
  report.set("skin/wrinkling_faces", skin.wrinkling);
  report.set("skin/wrinkling_area_percent", 100 * skin.wrinkling_share);
  report.set("skin/least_resultant_N_per_m", skin.least_resultant_N_per_m);
  report.set("skin/longest_wrinkle_mm", skin.longest_wrinkle_mm);
  report.set("skin/folds", skin.folds.edges);
  report.set("skin/sharpest_fold_degrees", skin.folds.sharpest_deg);
}

// For a solve without a stable solution: the cause of the instability, and the change that would
// remove it.
void write_stability(const SolveSummary& summary, Report& report) {
  if (summary.skin_share) report.set("stability/skin_share_percent", 100 * *summary.skin_share);
  if (!summary.remedy) return;
  const Remedy& remedy = *summary.remedy;
  report.set("stability/change", remedy.what);
  if (remedy.factor > 0) report.set("stability/factor", remedy.factor);
  if (remedy.support > 0) report.set("stability/support_kPa_per_mm", remedy.support);
}

}  // namespace

void write_report(const Equilibrium& summary, const HexMesh& mesh, const MechanicsOptions& options,
                  Report& report) {
  report.set("side", side_name(mesh.side));
  report.set("status", status_name(summary.record.status));
  report.set("reason", summary.reason_id.empty() ? summary.record.reason : summary.reason_id);
  if (!summary.reason_id.empty()) {
    report.set("explanation", summary.record.reason);
    report.set("load_reached", summary.load_reached);
  }
  if (summary.stiffness_factor_needed > 0) {
    report.set("stiffness_factor_needed", summary.stiffness_factor_needed);
  }
  write_stability(summary, report);
  report.set("elements", mesh.elements());
  report.set("unknowns", summary.unknowns);
  report.set("newton_iterations", summary.newton_iterations);
  report.set("linear_iterations", summary.linear_iterations);
  report.set("factorisations", summary.factorisations);
  if (!summary.linear_solver.empty()) {
    report.set("solver/name", summary.linear_solver);
    report.set("solver/matrix_values", summary.matrix_values);
    report.set("solver/factor_values", summary.factor_values);
    report.set("solver/factorisation_gflop", summary.factor_gflop);
    const auto spent = summary.timer.seconds().find("factorisation");
    if (spent != summary.timer.seconds().end() && spent->second > 0 && summary.factor_gflop > 0) {
      // The last factorisation of backward is timed as the check of stability.
      const int timed =
          summary.factorisations - (summary.timer.seconds().count("stability") ? 1 : 0);
      report.set("solver/factorisation_gflop_per_second",
                 summary.factor_gflop * timed / spent->second);
    }
  }
  report.set("steps", summary.steps);
  report.set("residual", summary.residual);
  report.set("min_det_F", summary.min_det_F);
  report.set("max_volume_error", summary.max_volume_error);
  report.set("error_estimate_mm", summary.error_estimate_mm >= 0
                                      ? summary.error_estimate_mm
                                      : std::numeric_limits<double>::quiet_NaN());  // null
  if (!summary.error_estimate_how.empty()) {
    report.set("error_estimate_how", summary.error_estimate_how);
  }
  if (summary.error_estimate_mm >= 0) {
    for (const auto& [name, error] : summary.landmark_error_mm) {
      report.set("landmarks/" + name + "/error_estimate_mm", error.norm());
    }
  }
  report.set("stable", summary.stable);
  report.set("element", element_name(options.element));
  report.set("invariants", invariants_name(options.invariants));
  if (options.bulk_ratio > 0) report.set("bulk_ratio", options.bulk_ratio);
  report.set("model", describe_model(options));
  report.set("wall", options.wall->text());
  report.set("skin_law/compression_percent", 100 * options.materials.skin.kept);
  report.set("skin_law/prestretch_percent", 100 * options.materials.skin.prestretch);
  report.set("cut", options.cut->text());
  report.set("blas", blas_name());
  const std::vector<Vec3>& points = summary.points.empty() ? mesh.points : summary.points;
  const MeshQuality quality = mesh_quality(mesh, points);
  report.set("min_scaled_jacobian", quality.min_scaled_jacobian);
  report.set("peak_mb", peak_memory_mb());
  write_materials(mesh, options, report);
  write_landmarks(mesh, points, report);
  write_field_checks(summary, report);
  summary.timer.write(report);
  for (const std::string& doubt : summary.doubts) report.append("doubts", doubt);
}

}  // namespace breast
