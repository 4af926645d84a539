// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/outcomes.hpp"

#include "core/text/one_line.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace {

Row outcome_row(const std::filesystem::path& name, const std::vector<std::string>& landmarks,
                const ShapeReader& read) {
  const StageReport report = StageReport::read(name.string() + ".json");
  const auto elements = report.first("elements");
  Row row{name.parent_path().filename(),
          name.filename(),
          cell_or_dash(one_line(report.text("status"))),
          cell_or_dash(one_line(report.text("reason"))),
          elements ? format_number(*elements) : no_value,
          fixed_cell(report.number("cpu_seconds"), 2)};
  const std::string stage = name.filename(), file = name.string() + ".vtkhdf";
  const bool shape = stage == "reference" || stage == "supine" || stage == "cc" || stage == "mlo";
  if (!shape || !std::filesystem::exists(file)) {
    row.insert(row.end(), landmarks.size(), no_value);
    return row;
  }
  const Shape found = read(file);
  for (const std::string& landmark : landmarks)
    row.push_back(format_fixed(moved(find_landmark(found, landmark, file)), 4));
  return row;
}

}  // namespace

Table outcomes_table(const std::filesystem::path& folder, const std::vector<std::string>& landmarks,
                     const std::vector<std::string>& variants, const ShapeReader& read) {
  Table table{{"variant", "stage", "status", "reason", "elements", "cpu_seconds"}, {}};
  for (const std::string& landmark : landmarks) table.columns.push_back(landmark + "_mm");
  for (const std::string& variant : variants)
    for (const char* stage :
         {"labels", "geometry", "mesh", "reference", "supine", "cc", "mlo", "curve", "slopes"})
      if (std::filesystem::exists(folder / variant / (std::string(stage) + ".json")))
        table.rows.push_back(outcome_row(folder / variant / stage, landmarks, read));
  return table;
}

}  // namespace breast
