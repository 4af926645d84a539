// fit-hermite: bicubic Hermite sheets of skin and chest wall, and the rim where the body ends.
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "fit/fit_breast.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"

namespace {

using namespace breast;

/// "10x12" -> patches along s (x) and t (z); auto: as many as the largest distance needs.
void parse_elements(const std::string& text, FitOptions& options) {
  if (text == "auto") {
    options.most_patches = 15;
    return;
  }
  char* end = nullptr;
  const long s = std::strtol(text.c_str(), &end, 10);
  const bool cross = *end == 'x' || *end == 'X';
  const long t = cross && std::isdigit(static_cast<unsigned char>(end[1]))
                     ? std::strtol(end + 1, &end, 10)
                     : 0;
  if (!cross || *end != 0 || s < 3 || s > 40 || t < 3 || t > 40)
    throw input_error("--elements ", text,
                      ": must be auto or AxB with A and B in 3..40, such as 10x10");
  options.patches_s = int(s);
  options.patches_t = int(t);
}

void parse_smoothing(const std::string& text, FitOptions& options) {
  options.smoothing = 0;
  if (text == "auto") return;
  char* end = nullptr;
  options.smoothing = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 0 || !(options.smoothing > 0 && options.smoothing <= 1))
    throw input_error("--smoothing ", text,
                      ": must be auto or a number above 0 and at most 1 "
                      "(automatic choices lie between 1e-9 and 1e-6)");
}

void report_distances(Report& report, const std::string& key, const DistanceSummary& summary) {
  report.set(key + "/mean_mm", summary.mean_mm);
  report.set(key + "/p95_mm", summary.p95_mm);
  report.set(key + "/max_mm", summary.max_mm);
}

void report_rim(Report& report, const Rim& rim) {
  const char* names[] = {"thin_tissue", "slope", "margin"};
  for (int reason = 0; reason < 3; ++reason) {
    int count = 0;
    for (const RimEnd end : rim.end) count += int(end) == reason;
    report.set(std::string("rim/ended/") + names[reason], double(count) / double(rim.end.size()));
  }
  report.set("rim/points", rim.skin.size());
  report.set("rim/wider_mm", rim.wider_mm);
  report.set("rim/least_thickness_mm", rim.least_thickness_mm);
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
  report.set("wall/coverage_percent", 100 * fit.wall_coverage);
  report_rim(report, fit.rim);
  report.set("landmarks/nipple/imaged", geometry.nipple);
  report.set("landmarks/nipple/moved_mm", fit.nipple_moved_mm);
  report.set("volumes_ml/body", fit.body_ml);
  report.set("volumes_ml/labels", fit.label_ml);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path labels_file, geometry_file;
  std::string elements = "auto", smoothing = "auto";
  std::optional<double> max_error;
  Tool tool("fit-hermite", "smooth surfaces of skin and chest wall from labels");
  tool.describe(
      "Fits two bicubic Hermite sheets, larger than the body, to the skin and to the front of the "
      "chest wall, and finds the rim: the closed curve where the breast ends and a straight cut "
      "joins "
      "the sheets. The skin need not be a graph over the chest wall: it is mapped to a square "
      "first. "
      "Fitting alternates closest-point projection and linear least squares with smoothing by "
      "second "
      "derivatives.");
  tool.cite("Pathmanathan et al., IEEE Trans Biomed Eng 55(10), 2008, section II-A")
      .cite(
          "Yoshizawa, Belyaev, Seidel, Proc. Shape Modeling International, 2004 (map to the "
          "square)");
  tool.input(labels_file, "LABELS.vtkhdf", "labels of one breast (segment)");
  tool.output(geometry_file, "GEOMETRY.vtkhdf", "two sheets and the rim");
  tool.text(elements, "--elements", "AxB|auto",
            "patches of each sheet along x and z; auto: 10x10, and of the skin up to 15x15 where "
            "it would lie more than 2 mm off");
  tool.text(smoothing, "--smoothing", "S|auto",
            "weight of the skin's squared second derivatives (parameters 0..1, mm); auto lowers it "
            "until the rms distance is 0.3 mm");
  tool.number(max_error, "--max-error", "MM",
              "refine the skin sheet until no point of the skin is farther from it", 0.05, 100);
  tool.example("fit-hermite labels.vtkhdf geometry.vtkhdf",
               "10 x 10 patches or a few more, automatic smoothing");
  tool.example("fit-hermite labels.vtkhdf geometry.vtkhdf --max-error 1",
               "as many patches as it takes to stay within 1 mm");
  FitOptions options;
  tool.check([&] {
    parse_elements(elements, options);
    parse_smoothing(smoothing, options);
    options.max_error_mm = max_error.value_or(0);
  });
  return tool.main(argc, argv, [&](Run& run) {
    LabelVolume labels;
    {
      Timer::Scope phase(run.timer(), "read");
      labels = read_labels(labels_file);
    }
    FitReport fit;
    BreastGeometry geometry = fit_breast(labels, options, fit, run.timer(), run.progress());
    report_fit(run.report(), fit, geometry);
    for (const std::string& doubt : fit.doubts) run.warn(doubt);
    geometry.history = run.history({{labels_file, labels.content_sha256, &labels.history}});
    Timer::Scope phase(run.timer(), "write");
    write_geometry(geometry_file, geometry);
    run.progress().note(message("skin to sheet: mean ", fit.skin_to_sheet.mean_mm, ", 95 % ",
                                fit.skin_to_sheet.p95_mm, ", largest ", fit.skin_to_sheet.max_mm,
                                " mm; ", fit.body_ml, " ml inside the rim"));
  });
}
