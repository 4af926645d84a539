// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/report.hpp"

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

void write_distance(const char* part, const Distances& distance, Report& report) {
  const std::string key = std::string("boundary/") + part;
  report.set(key + "_mean_mm", distance.mean_mm);
  report.set(key + "_p95_mm", distance.p95_mm);
  report.set(key + "_max_mm", distance.max_mm);
}

void write_boundary(const HexMesh& mesh, const BodyMeshReport& body, Report& report) {
  report.set("order", mesh.order);
  write_distance("skin", body.skin_distance, report);
  write_distance("wall", body.wall_distance, report);
  write_distance("cut", body.cut_distance, report);
  if (mesh.order == 1) return;
  report.set("boundary/curved_nodes", body.curved.nodes);
  report.set("boundary/largest_bow_mm", body.curved.largest_bow);
  report.set("boundary/held_back_nodes", body.curved.held_back);
  report.set("boundary/held_back_by_mm", body.curved.largest_gap);
}

}  // namespace

void write_report(const HexMesh& mesh, const MeshQuality& quality, const BodyMeshReport& body,
                  const TissueReport& tissue, Report& report) {
  report.set("side", side_name(mesh.side));
  report.set("elements", mesh.elements());
  report.set("nodes", mesh.nodes());
  report.set("placed_min_scaled_jacobian", body.placed_scaled_jacobian);
  report.set("min_scaled_jacobian", quality.min_scaled_jacobian);
  report.set("median_scaled_jacobian", quality.median_scaled_jacobian);
  report.set("min_det_mm3", quality.min_det);
  report.set("min_det_bound_mm3", quality.min_det_bound);
  report.set("scaled_jacobian_histogram",
             std::vector<double>(quality.histogram.begin(), quality.histogram.end()));
  report.set("elements_below_02", quality.below_02);
  write_boundary(mesh, body, report);
  const auto volumes = tissue_volumes(mesh);
  for (int t = 0; t < n_tissues; ++t) {
    if (volumes[t] > 0) {
      report.set("volumes_ml/" + std::string(tissue_name(Tissue(t))), volumes[t] / mm3_per_ml);
    }
  }
  report.set("volume_ml", body.mesh_volume / mm3_per_ml);
  report.set("fibroglandular_by_fraction_ml", tissue.fibroglandular_volume / mm3_per_ml);
  report.set("fibroglandular_threshold", tissue.gland_threshold);
  report.set("skin_shift_mm", body.skin_shift);
  report.set("segmented_volume_ml", tissue.segmented_volume / mm3_per_ml);
  report.set("volume_error_percent", 100 * (body.mesh_volume / tissue.segmented_volume - 1));
  report.set("sheet_volume_error_percent", 100 * (body.mesh_volume / body.body_volume - 1));
  report.set("outside_breast_percent", 100 * tissue.outside_fraction);
  report.set("breast_missed_percent", 100 * tissue.missed_fraction);
  for (const Landmark& landmark : mesh.landmarks) {
    report.set("landmarks/" + landmark.name + "/imaged", landmark.imaged);
    report.set("landmarks/" + landmark.name + "/moved_mm", landmark.moved);
  }
}

std::vector<std::string> doubts(const MeshQuality& quality) {
  if (quality.below_01 == 0) return {};
  return {message(quality.below_01, " elements have a scaled Jacobian below 0.1 (smallest ",
                  format_fixed(quality.min_scaled_jacobian, 3), "): solves will be slower")};
}

}  // namespace breast
