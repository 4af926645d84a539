// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/budget.hpp"

#include <map>

#include "core/text/lists.hpp"
#include "core/text/one_line.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace {

// The stages of the chain that a row replaces.
const std::map<std::string, std::vector<std::string>> stages{
    {"chain",
     {"labels", "geometry", "mesh", "reference", "supine", "truth-cc", "truth-mlo", "cc-mammogram",
      "mlo-mammogram"}},
    {"segmentation", {"labels"}},
    {"body", {"labels", "geometry", "mesh"}},
    {"tissue", {"labels"}},
    {"discretisation", {"reference", "supine", "truth-cc", "truth-mlo"}},
    {"backward", {"reference"}},
    {"compression", {"reference", "truth-cc", "truth-mlo"}}};

std::string cpu_cell(const std::filesystem::path& run, const std::string& row) {
  const auto replaced = stages.find(row);
  if (replaced == stages.end()) return "0";
  double total = 0;
  for (const std::string& stage : replaced->second)
    total += StageReport::read(run / (stage + ".json")).number("cpu_seconds").value_or(0);
  return format_fixed(total, 2);
}

std::string missing(const std::filesystem::path& run, const std::string& row) {
  const std::filesystem::path solves = variant_of(run, "budget", row);
  std::vector<std::string> said;
  if (row == "compression") said.push_back("stress-free, supine: not solved in this row");
  for (const std::string shape : {"reference", "supine", "cc", "mlo"}) {
    const auto failure = failure_of(solves / shape);
    if (!failure) continue;
    const std::string reason = StageReport::read(solves / (shape + ".json")).text("reason");
    said.push_back(shape + ": " + one_line(reason.empty() ? *failure : reason));
  }
  return cell_or_dash(join(said, "; "));
}

}  // namespace

Table budget_table(const std::filesystem::path& run, const std::vector<std::string>& rows) {
  Table table{{"replaced", "stress_free_mean_mm", "stress_free_largest_mm", "supine_mean_mm",
               "supine_largest_mm", "curve_mean_mm", "curve_p95_mm", "curve_largest_mm", "cpu_s",
               "missing"},
              {}};
  std::vector<std::string> all{"chain"};
  all.insert(all.end(), rows.begin(), rows.end());
  for (const std::string& name : all) {
    const std::filesystem::path folder = run / "budget" / name;
    const auto landmarks = table_if_any(folder / "landmarks.tsv"),
               curves = table_if_any(folder / "curves-summary.tsv");
    Row row{name};
    for (const std::string shape : {"stress_free", "supine"})
      for (const std::string which : {"mean", "largest"})
        row.push_back(landmarks ? fixed_cell(number_at(*landmarks, which, shape + "_error_mm"), 3)
                                : no_value);
    for (const std::string which : {"mean", "p95", "largest"})
      row.push_back(curves ? fixed_cell(number_at(*curves, which, "true_to_curve_mm"), 3)
                           : no_value);
    row.insert(row.end(), {cpu_cell(run, name), missing(run, name)});
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace breast
