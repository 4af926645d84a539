// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/paper/conclusions.hpp"

#include <cmath>
#include <functional>

#include "study/cells.hpp"
#include "study/paper/scaled_table.hpp"
#include "study/paper/slopes.hpp"
#include "study/stage_report.hpp"

namespace breast {

std::optional<std::size_t> slope_row_of(const Table& slopes, const std::string& landmark,
                                        const std::string& parameter) {
  for (std::size_t r = 0; r < slopes.rows.size(); ++r) {
    const std::string& name = slopes.cell(r, "landmark");
    if ((name == landmark || name == "artificial_" + landmark) &&
        slopes.cell(r, "parameter") == parameter)
      return r;
  }
  return {};
}

std::string slope_cell(const Table& slopes, const std::string& landmark,
                       const std::string& parameter, int decimals) {
  const auto row = slope_row_of(slopes, landmark, parameter);
  return row ? format_fixed(slopes.number(*row, "dlnu"), decimals) : no_value;
}

namespace {

using SlopeOf = std::function<std::string(std::size_t tissue, const std::string& landmark)>;
const std::array<std::string, 3> tissues{"fat", "fibroglandular", "skin"};

// Whether the first is more than three times the second and the second larger than the third, in
// magnitude.
std::string in_order(const std::array<std::string, 3>& slopes) {
  std::array<double, 3> size{};
  for (std::size_t t = 0; t < size.size(); ++t) {
    const auto value = number_of(slopes[t]);
    if (!value) return no_value;
    size[t] = std::abs(*value);
  }
  return size[0] > 3 * size[1] && size[1] > size[2] ? "1" : "0";
}

std::string change(const Table& stiff, const std::string& percent, const std::string& column) {
  const auto here = number_at(stiff, percent, column), base = number_at(stiff, "100", column);
  if (!here || !base || !(*base > 0)) return no_value;
  return format_fixed(100 * (*here / *base - 1), 3);
}

Table conclusions(const SlopeOf& slope, const Table& stiff, const std::string& prefix) {
  Table table{{"conclusion", "value"}, {}};
  for (const std::string landmark : {"nipple", "tumour"}) {
    std::array<std::string, 3> slopes;
    for (std::size_t t = 0; t < tissues.size(); ++t) {
      slopes[t] = slope(t, landmark);
      table.rows.push_back({tissues[t] + "_" + landmark, slopes[t]});
    }
    table.rows.push_back({"order_" + landmark, in_order(slopes)});
  }
  table.rows.push_back({"tumour_1000", change(stiff, "1000", prefix + "tumour_mm")});
  table.rows.push_back({"tumour_2000", change(stiff, "2000", prefix + "nipple_mm")});
  return table;
}

std::string verdict(const std::string& value, double low, double high) {
  const auto number = number_of(value);
  if (!number) return "not evaluated";
  return *number >= low && *number <= high ? "holds" : "fails";
}

}  // namespace

Table conclusions_from_rows(const std::array<Table, 4>& tables, const std::string& prefix) {
  return conclusions(
      [&](std::size_t tissue, const std::string& landmark) {
        const std::string column = prefix + landmark + "_mm";
        const auto low = number_at(tables[tissue], "90", column),
                   high = number_at(tables[tissue], "110", column);
        return low && high && *low > 0 && *high > 0
                   ? format_fixed(slope_between(90, *low, 110, *high), 4)
                   : no_value;
      },
      tables[3], prefix);
}

Table conclusions_from_slopes(const std::optional<Table>& slopes, const Table& stiff) {
  return conclusions(
      [&](std::size_t tissue, const std::string& landmark) {
        return slopes ? slope_cell(*slopes, landmark, tissues[tissue], 4) : no_value;
      },
      stiff, "");
}

Table judge(const Table& conclusions, const std::vector<JudgedModel>& models) {
  Table table{{"conclusion", "lowest", "highest"}, {}};
  for (const JudgedModel& model : models)
    model.values.column("value");  // throws for a table of another kind
  for (const JudgedModel& model : models)
    table.columns.insert(table.columns.end(), {model.name, model.name + "_verdict"});
  for (std::size_t r = 0; r < conclusions.rows.size(); ++r) {
    Row row{conclusions.cell(r, "text"), conclusions.cell(r, "lowest"),
            conclusions.cell(r, "highest")};
    for (const JudgedModel& model : models) {
      const std::string value =
          cell_or_dash(cell_at(model.values, conclusions.cell(r, "conclusion"), "value"));
      row.insert(row.end(), {value, verdict(value, conclusions.number(r, "lowest"),
                                            conclusions.number(r, "highest"))});
    }
    table.rows.push_back(row);
  }
  return table;
}

namespace {

// Tables III to VI of one model; `ending` distinguishes the names of its files from those of other
// models.
std::array<Table, 4> scaled_tables(const std::filesystem::path& tables, const std::string& ending) {
  const auto number = [&](const char* n) {
    return read_table(tables / ("table" + std::string(n) + ending + ".tsv"));
  };
  return {number("3"), number("4"), number("5"), number("6")};
}

// The rows of Table VI that the conclusions need: a tumour with 1, 10 and 20 times its stiffness.
Table stiff_rows(const Table& sixth, const std::filesystem::path& prefix, const ShapeReader& read) {
  Table wanted{sixth.columns, {}};
  wanted.name = sixth.name;
  for (const Row& row : sixth.rows)
    if (row.front() == "100" || row.front() == "1000" || row.front() == "2000")
      wanted.rows.push_back(row);
  return scaled_table(wanted, prefix, prefix.string() + "-100/supine.vtkhdf", read, "");
}

}  // namespace

Table judged_tables(const Table& conclusions, const std::filesystem::path& tables, bool printed) {
  const std::array<Table, 4> own = scaled_tables(tables, "");
  std::vector<JudgedModel> models{{"paper", conclusions_from_rows(own, "paper_")}};
  if (printed)
    models.push_back(
        {"as_printed", conclusions_from_rows(scaled_tables(tables, "-as-printed"), "")});
  models.push_back({"ours", conclusions_from_rows(own, "")});
  return judge(conclusions, models);
}

Table survival_table(const Table& conclusions, const PaperTables& paper,
                     const std::filesystem::path& run, const ShapeReader& read,
                     const std::vector<std::string>& sets, const std::string& calibrated) {
  const auto at = [&](const std::string& set) { return variant_of(run, "table8", set); };
  const std::array<Table, 4> own = scaled_tables(run / "tables", "");
  std::vector<JudgedModel> models{
      {"paper", conclusions_from_rows(own, "paper_")},
      {"ours", conclusions_from_slopes(table_if_any(run / "slopes.tsv"), own[3])}};
  for (const std::string& set : sets)
    models.push_back(
        {set, conclusions_from_slopes(table_if_any(at(set) / "slopes.tsv"),
                                      stiff_rows(paper.sixth, at(set + "-tumour"), read))});
  const Table judged = judge(conclusions, models);
  Table table{judged.columns, {}};
  Row body{"stress-free body of the imaged shape", "-", "-", "-", "", "yes", ""};
  for (const std::string& set : sets) {
    const auto failure = posture_failure_of(at(set));
    body.insert(body.end(), {failure ? "no" : "yes", failure.value_or("")});
  }
  table.rows.push_back(body);
  for (const std::string landmark : {"nipple", "tumour"}) {
    const auto shown = [&](const std::filesystem::path& file) {
      return format_fixed(moved(find_landmark(read(file), landmark, file)), 4);
    };
    Row row{"supine displacement of the " + landmark + ", mm",
            "-",
            "-",
            cell_at(paper.third, "100", landmark + "_mm"),
            "",
            shown(run / "supine.vtkhdf"),
            calibrated};
    for (const std::string& set : sets)
      row.insert(row.end(),
                 {posture_failure_of(at(set)) ? no_value : shown(at(set) / "supine.vtkhdf"), ""});
    table.rows.push_back(row);
  }
  table.rows.insert(table.rows.end(), judged.rows.begin(), judged.rows.end());
  return table;
}

}  // namespace breast
