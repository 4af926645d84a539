// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/compressions.hpp"

#include <algorithm>

#include "core/text/one_line.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

struct Column {
  const char* name;
  const char* key;  ///< of the report
  int decimals;
};

// The part of a plate's force that acts behind the edge of the image, in per cent.
std::string behind_edge(const StageReport& report, const std::string& plate) {
  const auto behind = report.number("plates/" + plate + "/force_behind_edge_N"),
             whole = report.number("plates/" + plate + "/force_N");
  if (!behind || !whole || *whole <= 0) return no_value;
  return format_fixed(100 * *behind / *whole, 1);
}

std::string view_of(const StageReport& report, const fs::path& file) {
  const std::string view = report.text("view");
  return view.empty() ? file.stem().string() : view;
}

void add_columns(const std::vector<Column>& columns, Table& table) {
  for (const Column& column : columns) table.columns.emplace_back(column.name);
}

void add_cells(const std::vector<Column>& columns, const StageReport& report, Row& row) {
  for (const Column& column : columns)
    row.push_back(fixed_cell(report.number(column.key), column.decimals));
}

const std::vector<Column> breast_columns{
    {"turn_deg", "turn_deg", 1}, {"T0_mm", "initial_thickness_mm", 1}, {"T_mm", "thickness_mm", 1}};
const std::vector<Column> press_columns{{"paddle_N", "force_N", 1},
                                        {"detector_N", "detector_force_N", 1},
                                        {"area_cm2", "area_cm2", 1},
                                        {"mean_pressure_kPa", "pressure_kPa", 1}};
const std::vector<Column> solution_columns{{"worst_gap_mm", "worst_gap_mm", 3},
                                           {"min_scaled_jacobian", "min_scaled_jacobian", 3},
                                           {"iterations", "newton_iterations", 0},
                                           {"cpu_seconds", "cpu_seconds", 0}};
const std::vector<Column> coverage_columns{
    {"volume_in_front_percent", "coverage/volume_percent", 1},
    {"gland_in_front_percent", "coverage/fibroglandular_percent", 1},
    {"thrust_into_wall_N", "thrust_into_wall_N", 1}};
const std::vector<std::string> edge_columns{"paddle_behind_edge_percent",
                                            "detector_behind_edge_percent"};

// What both tables state: forces and pressure, the part behind the edge, and the solution.
void add_press_columns(Table& table) {
  add_columns(press_columns, table);
  table.columns.insert(table.columns.end(), edge_columns.begin(), edge_columns.end());
  add_columns(solution_columns, table);
}

void add_press_cells(const StageReport& report, Row& row) {
  add_cells(press_columns, report, row);
  for (const char* plate : {"paddle", "detector"}) row.push_back(behind_edge(report, plate));
  add_cells(solution_columns, report, row);
}

std::string distance(const fs::path& here, const fs::path& there, const char* landmark,
                     const ShapeReader& read) {
  if (!fs::exists(here) || !fs::exists(there)) return no_value;
  return format_fixed(apart_at(read, here, there, landmark), 2);
}

}  // namespace

Table compressions_table(const std::vector<fs::path>& reports) {
  Table table{{"breast", "view", "status"}, {}};
  add_columns(breast_columns, table);
  add_press_columns(table);
  add_columns(coverage_columns, table);
  for (const fs::path& file : reports) {
    const StageReport report = StageReport::read(file);
    Row row{file.parent_path().filename(), view_of(report, file),
            cell_or_dash(one_line(report.text("status")))};
    add_cells(breast_columns, report, row);
    add_press_cells(report, row);
    add_cells(coverage_columns, report, row);
    table.rows.push_back(row);
  }
  return table;
}

Table plates_table(const fs::path& folder, const std::string& base,
                   const std::vector<std::string>& variants, const ShapeReader& read) {
  Table table{{"view", "variant", "elements"}, {}};
  add_press_columns(table);
  table.columns.insert(table.columns.end(), {"tumour_mm", "nipple_mm"});
  for (const std::string view : {"cc", "mlo"})
    for (std::size_t k = 0; k < variants.size(); ++k) {
      const fs::path file = folder / variants[k] / (view + ".json");
      const StageReport report = StageReport::read(file);
      if (report.empty()) continue;
      Row row{view_of(report, file), variants[k], fixed_cell(report.number("elements"), 0)};
      add_press_cells(report, row);
      const std::string& other =
          base == "next" ? variants[std::min(k + 1, variants.size() - 1)] : base;
      for (const char* landmark : {"tumour", "nipple"})
        row.push_back(other == variants[k]
                          ? no_value
                          : distance(folder / variants[k] / (view + ".vtkhdf"),
                                     folder / other / (view + ".vtkhdf"), landmark, read));
      table.rows.push_back(row);
    }
  return table;
}

}  // namespace breast
