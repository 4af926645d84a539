// SPDX-License-Identifier: GPL-3.0-or-later
// fit-hermite: bicubic Hermite sheets of skin and chest wall, and the rim where the body ends.
#include <algorithm>

#include "core/error.hpp"
#include "fit_hermite_options.hpp"
#include "io/geometry_file.hpp"

namespace {

using namespace breast;

void report_distances(Report& report, const std::string& key, const Distances& summary) {
  report.set(key + "/mean_mm", summary.mean_mm);
  report.set(key + "/p95_mm", summary.p95_mm);
  report.set(key + "/max_mm", summary.max_mm);
}

void report_rim(Report& report, const Rim& rim) {
  const char* names[] = {"thin_tissue", "slope", "margin"};
  for (int reason = 0; reason < 3; ++reason) {
    const auto count = std::count(rim.end.begin(), rim.end.end(), RimEnd(reason));
    report.set(std::string("rim/ended/") + names[reason], double(count) / double(rim.end.size()));
  }
  report.set("rim/points", rim.skin.size());
  report.set("rim/beyond_labels_mm",
             std::vector<double>{rim.beyond_labels_min_mm, rim.beyond_labels_median_mm,
                                 rim.beyond_labels_max_mm});
  report.set("rim/farthest_beyond", rim.farthest_beyond);
  report.set("rim/wider_mm", rim.wider_mm);
  report.set("rim/greatest_thickness_mm", rim.greatest_thickness_mm);
  report.set(
      "rim/cut_height_mm",
      std::vector<double>{rim.cut_height_min_mm, rim.cut_height_median_mm, rim.cut_height_max_mm});
  report.set("rim/skin_angle_deg",
             std::vector<double>{rim.skin_angle_min, rim.skin_angle_median, rim.skin_angle_max});
  report.set("rim/wall_angle_deg",
             std::vector<double>{rim.wall_angle_min, rim.wall_angle_median, rim.wall_angle_max});
}

void report_fit(Report& report, const FitReport& fit, const BreastGeometry& geometry) {
  report_distances(report, "fit", fit.skin_to_sheet);
  report_distances(report, "fit/sheet_to_skin", fit.sheet_to_skin);
  report_distances(report, "fit/whole_sheet", fit.whole_skin_to_sheet);
  report.set("fit/max_at", fit.worst_point);
  report.set("fit/points", fit.data_points);
  report.set("fit/elements", std::vector<double>{double(fit.patches_s), double(fit.patches_t)});
  report.set("fit/smoothing", fit.smoothing);
  report.set("fit/rms_mm", fit.rms_mm);
  report.set("fit/iterations", fit.loops);
  report.set("fit/map_area_ratio_p95", fit.area_ratio_p95);
  report.set("fit/min_normal_cosine", fit.min_normal_cosine);
  report.set("fit/min_area_ratio", fit.min_area_ratio);
  report.set("wall/rms_mm", fit.wall_rms_mm);
  report.set("wall/p95_mm", fit.wall_p95_mm);
  report.set("thorax/half_width_mm", fit.thorax.half_width_mm);
  report.set("thorax/half_depth_mm", fit.thorax.half_depth_mm);
  report.set("thorax/wall_points", fit.thorax.wall_points);
  report.set("thorax/wall_mean_mm", fit.thorax.wall_mean_mm);
  report.set("thorax/wall_p95_mm", fit.thorax.wall_p95_mm);
  report.set("thorax/sheet_max_mm", fit.thorax.sheet_max_mm);
  report.set("wall/coverage_percent", 100 * fit.wall_coverage);
  report_rim(report, fit.rim);
  report.set("side", side_name(geometry.side));
  report.set("landmarks/nipple/imaged", geometry.nipple);
  report.set("landmarks/nipple/moved_mm", fit.nipple_moved_mm);
  report.set("volumes_ml/body", fit.body_ml);
  report.set("volumes_ml/labels", fit.label_ml);
}

void run_fit(const FitChoices& choices, Run& run) {
  const LabelInput input = [&] {
    const Timer::Scope phase(run.timer(), "read");
    Pairs pairs = pairs_of("fit-hermite", run, choices.foreign.accept_other);
    return read_label_input(choices.labels, choices.foreign, pairs, run);
  }();
  const LabelVolume& labels = input.labels;
  FitReport fit;
  BreastGeometry geometry = fit_breast(labels, choices.options(), fit, run.timer(), run.progress());
  report_fit(run.report(), fit, geometry);
  for (const std::string& mended : fit.mended) {
    run.report().append("mended", mended);
    run.warn(mended);
  }
  for (const std::string& doubt : fit.doubts) run.warn(doubt);
  geometry.history = run.history(inputs_of(choices.labels, choices.foreign, input));
  const Timer::Scope phase(run.timer(), "write");
  write_geometry(choices.geometry, geometry);
  run.progress().note(message("skin to sheet: mean ", fit.skin_to_sheet.mean_mm, ", 95 % ",
                              fit.skin_to_sheet.p95_mm, ", largest ", fit.skin_to_sheet.max_mm,
                              " mm; ", fit.body_ml, " ml inside the rim"));
}

}  // namespace

int main(int argc, char** argv) {
  FitChoices choices;
  Tool tool("fit-hermite", "smooth surfaces of skin and chest wall from labels");
  declare_fit_hermite(tool, choices);
  return tool.main(argc, argv, [&](Run& run) { run_fit(choices, run); });
}
