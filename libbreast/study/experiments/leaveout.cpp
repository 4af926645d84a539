// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/leaveout.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

double seconds_of(const fs::path& folder, const std::vector<std::string>& stages) {
  double total = 0;
  for (const std::string& stage : stages)
    total += StageReport::read(folder / (stage + ".json")).number("cpu_seconds").value_or(0);
  // Computed from the printed values, so that the saving is the difference of two cells of the
  // table.
  return parse_number(format_fixed(total, 1), "seconds");
}
const std::vector<std::string> surgery_stages{"reference", "supine"},
    matching_stages{"reference", "cc", "mlo"};

double change_of(const Table& table, const std::string& variant, const std::string& question) {
  if (question == "matching") return number_at(table, variant, "curve_max_mm").value_or(0);
  return std::max(number_at(table, variant, "supine_tumour_mm").value_or(0),
                  number_at(table, variant, "supine_nipple_mm").value_or(0));
}

}  // namespace

Table leaveout_table(const fs::path& run, const std::vector<std::string>& variants,
                     const ShapeReader& read, const CurveReader& curves) {
  const double surgery = seconds_of(run, surgery_stages),
               matching = seconds_of(run, matching_stages);
  const auto force = [](const fs::path& of) {
    return fixed_cell(StageReport::read(of / "cc.json").number("force_N"), 1);
  };
  Table table{{"variant", "supine_tumour_mm", "supine_nipple_mm", "cc_tumour_mm", "mlo_tumour_mm",
               "curve_mean_mm", "curve_max_mm", "cc_force_N", "surgery_cpu_s", "surgery_saved_s",
               "matching_cpu_s", "matching_saved_s"},
              {{"base", "0", "0", "0", "0", "0", "0", force(run), format_fixed(surgery, 1), "0",
                format_fixed(matching, 1), "0"}}};
  for (const std::string& variant : variants) {
    const fs::path at = variant_of(run, "leaveout", variant);
    const auto gap = [&](const char* shape, const char* landmark) {
      return format_fixed(apart_at(read, at / shape, run / shape, landmark), 3);
    };
    const CurveGap curve = curves(at / "curve.vtp", run / "curve.vtp");
    const double own_surgery = seconds_of(at, surgery_stages),
                 own_matching = seconds_of(at, matching_stages);
    table.rows.push_back({variant, gap("supine.vtkhdf", "tumour"), gap("supine.vtkhdf", "nipple"),
                          gap("cc.vtkhdf", "tumour"), gap("mlo.vtkhdf", "tumour"),
                          format_fixed(curve.mean, 3), format_fixed(curve.most, 3), force(at),
                          format_fixed(own_surgery, 1), format_fixed(surgery - own_surgery, 1),
                          format_fixed(own_matching, 1), format_fixed(matching - own_matching, 1)});
  }
  return table;
}

std::vector<PartChange> changes(const Table& leaveout, const std::string& question,
                                const std::vector<std::string>& parts) {
  if (question != "surgery" && question != "matching")
    throw input_error("'", question, "' is not a question; use surgery or matching");
  std::vector<PartChange> list;
  for (const std::string& part : parts) {
    if (question == "surgery" && part == "no-gravity-in-compression")
      continue;  // a question without a compression
    list.push_back({part, change_of(leaveout, part, question)});
  }
  std::stable_sort(list.begin(), list.end(), [](const PartChange& a, const PartChange& b) {
    return a.change != b.change ? a.change < b.change : a.part < b.part;
  });
  return list;
}

std::vector<PartChange> least_model(const std::vector<PartChange>& changes, double allowed) {
  std::vector<PartChange> chosen;
  double sum = 0;
  for (const PartChange& part : changes) {
    sum += part.change;
    if (sum <= allowed) chosen.push_back(part);
  }
  return chosen;
}

Table recommendation(const fs::path& run, double allowed, const std::vector<std::string>& parts,
                     const ShapeReader& read, const CurveReader& curves) {
  Table table{{"question", "allowed_mm", "left_out", "sum_of_changes_mm", "measured_mm", "cpu_s",
               "base_cpu_s", "saved_percent", "keeps_the_error"},
              {}};
  const Table measured = read_table(run / "leaveout/table.tsv");
  for (const std::string question : {"surgery", "matching"}) {
    std::vector<std::string> names;
    double sum = 0;
    for (const PartChange& part : least_model(changes(measured, question, parts), allowed)) {
      names.push_back(part.part);
      sum += part.change;
    }
    const std::string least = "least-" + question, cpu = question + "_cpu_s";
    const Table own = leaveout_table(run, {least}, read, curves);
    const double change = change_of(own, least, question),
                 seconds = number_at(own, least, cpu).value_or(0),
                 base = number_at(own, "base", cpu).value_or(0);
    table.rows.push_back(
        {question, format_number(allowed), names.empty() ? "nothing" : join(names, " "),
         format_fixed(sum, 3), format_fixed(change, 3), cell_at(own, least, cpu),
         cell_at(own, "base", cpu), format_fixed(base > 0 ? 100 * (1 - seconds / base) : 0, 0),
         change <= allowed ? "yes" : "no"});
  }
  return table;
}

Table wall_table(const fs::path& run, const std::vector<std::string>& variants) {
  Table table{{"wall", "sigma_mean_mm", "volume_ml", "supine_tumour_mm", "supine_nipple_mm",
               "cc_tumour_mm", "mlo_tumour_mm"},
              {}};
  const auto start = [](const std::string& name, const fs::path& folder) {
    return Row{name,
               fixed_cell(StageReport::read(folder / "labels.json").first("sigma_mean_mm"), 2),
               fixed_cell(StageReport::read(folder / "mesh.json").first("volume_ml"), 1)};
  };
  table.rows.push_back(start("as found", run));
  table.rows.back().resize(table.columns.size(), "0");
  for (const std::string& variant : variants) {
    const fs::path folder = variant_of(run, "wall", variant);
    Row row = start(variant, folder);
    const std::vector<std::pair<std::string, std::string>> places{
        {"supine", "tumour"}, {"supine", "nipple"}, {"cc", "tumour"}, {"mlo", "tumour"}};
    for (const auto& [stage, landmark] : places) {
      const auto here = StageReport::read(folder / (stage + ".json")).place(landmark, "position");
      const auto there = StageReport::read(run / (stage + ".json")).place(landmark, "position");
      row.push_back(here && there ? format_fixed((*here - *there).norm(), 2) : no_value);
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace breast
