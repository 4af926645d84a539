// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/cohort/side_table.hpp"

#include <array>

#include "core/text/lists.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"
#include "study/summary.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 5> chain_stages = {"labels", "geometry", "mesh", "reference", "supine"};

/// The last stage whose file is there, with those before it.
std::string reached(const fs::path& run) {
  std::string last = "-";
  for (const char* stage : chain_stages) {
    if (!has_something(run / (std::string(stage) + ".vtkhdf"))) break;
    last = stage;
  }
  return last;
}

std::string mended(const StageReport& geometry, const StageReport& mesh) {
  std::vector<std::string> lines = geometry.texts("mended");
  for (const std::string& line : mesh.texts("mended")) lines.push_back(line);
  return cell_or_dash(join(lines, "; "));
}

/// A quantity of a table that evaluate printed.
std::string quantity(const std::optional<Table>& truth, const std::string& name, int decimals) {
  return truth ? fixed_cell(number_at(*truth, name, "value"), decimals) : no_value;
}

}  // namespace

Table side_table(const fs::path& runs, const std::vector<CohortCase>& cases) {
  Table table{{"case", "reached", "body_dice", "gland_dice", "wall_mean_mm", "wall_p95_mm",
               "wall_stated_mm", "fit_mean_mm", "fit_p95_mm", "min_scaled_jacobian", "volume_ml",
               "cpu_s", "peak_mb", "mended", "reason"},
              {}};
  const Table cost = cohort_cost(runs, cases);
  for (const CohortCase& one : cases) {
    const fs::path run = runs / one.name;
    const StageReport labels = StageReport::read(run / "labels.json"),
                      geometry = StageReport::read(run / "geometry.json"),
                      mesh = StageReport::read(run / "mesh.json");
    const std::optional<Table> truth = table_if_any(run / "labels-truth.tsv");
    table.rows.push_back(
        {one.name, reached(run), quantity(truth, "body_dice", 3),
         quantity(truth, "fibroglandular_dice", 3), quantity(truth, "wall_mean_mm", 1),
         quantity(truth, "wall_p95_mm", 1),
         fixed_cell(labels.number("chest_wall/sigma_mean_mm"), 1),
         fixed_cell(geometry.number("fit/mean_mm"), 2),
         fixed_cell(geometry.number("fit/p95_mm"), 2),
         fixed_cell(mesh.number("min_scaled_jacobian"), 2), fixed_cell(mesh.number("volume_ml"), 0),
         cell_at(cost, one.name, "cpu_seconds"), cell_at(cost, one.name, "peak_mb"),
         mended(geometry, mesh), cell_or_dash(one.reason)});
  }
  return table;
}

}  // namespace breast
