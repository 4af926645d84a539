// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/paper/findings.hpp"

#include "core/error.hpp"
#include "study/cells.hpp"
#include "study/paper/conclusions.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// Distance in mm from the landmark's imaged position.
double moved_in(const fs::path& file, const std::string& landmark) {
  const StageReport report = StageReport::read(file);
  const auto from = report.place(landmark, "imaged"), to = report.place(landmark, "position");
  if (!from || !to) throw input_error(file.string(), ": has no landmark '", landmark, "'");
  return (*to - *from).norm();
}

std::string beyond(double value, const std::optional<double>& finest) {
  if (!finest || !(*finest > 0)) return no_value;
  const double percent = 100 * (value / *finest - 1);
  return (percent < 0 ? "" : "+") + format_fixed(percent, 2);
}

struct Finest {
  std::optional<double> nipple, tumour;
};

Row finding(const std::string& name, const fs::path& reference, const fs::path& supine,
            const Table& slopes, const Finest& finest) {
  const StageReport report = StageReport::read(supine);
  const double nipple = moved_in(supine, "nipple"), tumour = moved_in(supine, "tumour");
  return {name,
          report.text("elements"),
          format_fixed(moved_in(reference, "nipple"), 3),
          format_fixed(moved_in(reference, "tumour"), 3),
          format_fixed(nipple, 3),
          format_fixed(tumour, 3),
          beyond(nipple, finest.nipple),
          beyond(tumour, finest.tumour),
          fixed_cell(report.number("error_estimate_mm"), 3),
          slope_cell(slopes, "nipple", "fat", 3),
          slope_cell(slopes, "tumour", "fat", 3)};
}

}  // namespace

Table findings_table(const fs::path& run, const std::vector<std::string>& variants) {
  Table table{{"model", "elements", "stress_free_nipple_mm", "stress_free_tumour_mm",
               "supine_nipple_mm", "supine_tumour_mm", "nipple_from_finest_percent",
               "tumour_from_finest_percent", "estimate_mm", "fat_slope_nipple", "fat_slope_tumour"},
              {{"paper", "4096", "4.5", "1.6", "8.78", "3.03", "-", "-", "-", "-0.607", "-0.705"}}};
  const auto at = [&](const std::string& variant) { return variant_of(run, "findings", variant); };
  const auto stage = [&](const std::string& variant, const char* name) {
    return (at(variant) / name).string();
  };
  Finest finest;
  if (!posture_failure_of(at(variants.back()))) {
    const fs::path supine = stage(variants.back(), "supine") + ".json";
    finest = {moved_in(supine, "nipple"), moved_in(supine, "tumour")};
  }
  table.rows.push_back(finding("default", run / "reference.json", run / "supine.json",
                               read_table(run / "slopes.tsv"), finest));
  for (const std::string& variant : variants) {
    if (posture_failure_of(at(variant))) {
      table.rows.push_back(Row(table.columns.size(), no_value));
      table.rows.back().front() = variant;
    } else {
      table.rows.push_back(finding(variant, stage(variant, "reference") + ".json",
                                   stage(variant, "supine") + ".json",
                                   read_table(stage(variant, "slopes") + ".tsv"), finest));
    }
  }
  return table;
}

std::string calibration_note(const fs::path& truth, const std::string& side) {
  const StageReport report = StageReport::read(truth);
  if (report.text("parameters/preset") != "paper") return "";
  const auto moves = [&](const std::string& landmark) {
    return fixed_cell(report.number(side + "/landmarks/" + landmark + "/distance_mm"), 2);
  };
  return "calibrated to this row: size and tumour of the preset \"paper\" were fitted so that "
         "this chain moves nipple and tumour by as much as the paper (8.8 and 3.0 mm supine); the "
         "phantom's own truth moves " +
         moves("nipple") + " and " + moves("tumour") + " mm";
}

Table calibration_table(const fs::path& run, const fs::path& truth, const std::string& side,
                        const Table& landmarks) {
  Table table{{"model", "supine_nipple_mm", "supine_tumour_mm", "stress_free_nipple_mm",
               "stress_free_tumour_mm", "remark"},
              {{"the paper", "8.8", "3.0", "4.5", "1.6", ""}}};
  const auto add = [&](const std::string& name, const fs::path& supine, const fs::path& reference,
                       const std::string& remark) {
    table.rows.push_back({name, format_fixed(moved_in(supine, "nipple"), 2),
                          format_fixed(moved_in(supine, "tumour"), 2),
                          format_fixed(moved_in(reference, "nipple"), 2),
                          format_fixed(moved_in(reference, "tumour"), 2), remark});
  };
  const fs::path printed = variant_of(run, "findings", "as-printed");
  add("as printed in the paper", printed / "supine.json", printed / "reference.json",
      "calibrated to this row");
  add("default chain", run / "supine.json", run / "reference.json",
      "calibrated to this row, by the same fit");
  const StageReport report = StageReport::read(truth);
  Row row{"the phantom's truth"};
  for (const std::string landmark : {"nipple", "tumour"})
    row.push_back(fixed_cell(report.number(side + "/landmarks/" + landmark + "/distance_mm"), 2));
  for (const std::string landmark : {"nipple", "tumour"}) {
    std::string cell = no_value;
    for (std::size_t r = 0; r < landmarks.rows.size(); ++r)
      if (landmarks.cell(r, "landmark") == landmark && landmarks.cell(r, "side") == side)
        cell = format_fixed(
            (landmarks.point(r, "stress_free_") - landmarks.point(r, "prone_")).norm(), 2);
    row.push_back(cell);
  }
  row.push_back("");
  table.rows.push_back(row);
  return table;
}

}  // namespace breast
