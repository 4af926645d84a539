// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/paper/scaled_table.hpp"

#include <array>

#include "core/error.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace {

const std::array<std::string, 4> quantities{"tumour_mm", "tumour_rel_mm", "nipple_mm",
                                            "nipple_rel_mm"};

std::array<double, 4> displacements(const Shape& shape, const std::filesystem::path& file,
                                    const Shape& base, const std::filesystem::path& base_file) {
  const auto of = [&](const char* name) {
    const PlacedLandmark& here = find_landmark(shape, name, file);
    return std::pair(moved(here), apart(here, find_landmark(base, name, base_file)));
  };
  const auto tumour = of("tumour"), nipple = of("nipple");
  return {tumour.first, tumour.second, nipple.first, nipple.second};
}

}  // namespace

Table scaled_table(const Table& paper, const std::filesystem::path& prefix,
                   const std::filesystem::path& base, const ShapeReader& read,
                   const std::string& calibrated) {
  Table table{{"stiffness_percent"}, {}};
  for (const std::string& quantity : quantities)
    for (const std::string& column : {quantity, "paper_" + quantity, "difference_" + quantity})
      table.columns.push_back(column);
  table.columns.insert(table.columns.end(), {"estimate_mm", "remark"});
  // The displacements are relative to the base, so that without a base no row has any.
  const bool has_base = std::filesystem::exists(base);
  const Shape base_shape = has_base ? read(base) : Shape{};
  for (std::size_t r = 0; r < paper.rows.size(); ++r) {
    const std::string percent = paper.rows[r].front();
    const bool whole = percent == "100";
    const std::string name = whole ? std::filesystem::path(base).replace_extension().string()
                                   : prefix.string() + "-" + percent + "/supine";
    const std::filesystem::path file = name + ".vtkhdf";
    Row row{percent};
    std::string estimate = no_value;
    if (has_base && std::filesystem::exists(file)) {
      const auto ours = displacements(read(file), file, base_shape, base);
      for (std::size_t q = 0; q < ours.size(); ++q) {
        const std::string& theirs = paper.cell(r, quantities[q]);
        row.insert(row.end(), {format_fixed(ours[q], 3), theirs,
                               format_fixed(ours[q] - paper.number(r, quantities[q]), 3)});
      }
      estimate = fixed_cell(StageReport::read(name + ".json").number("error_estimate_mm"), 3);
    } else if (posture_failure_of(prefix.string() + "-" + percent)) {
      for (const std::string& quantity : quantities)
        row.insert(row.end(), {no_value, paper.cell(r, quantity), no_value});
    } else {
      throw failed_error(file.string(), ": is missing");
    }
    row.insert(row.end(), {estimate, whole && !calibrated.empty() ? calibrated : no_value});
    table.rows.push_back(row);
  }
  return table;
}

Table constants_table(const Table& paper, const Table& materials) {
  Table table{{"tissue", "constant", "used", "paper", "difference"}, {}};
  for (std::size_t r = 0; r < paper.rows.size(); ++r) {
    const std::string& tissue = paper.cell(r, "tissue");
    for (const std::string constant : {"a10_Pa", "a01_Pa", "a20_Pa", "a02_Pa", "a11_Pa"}) {
      const std::string used = cell_or_dash(cell_at(materials, tissue, constant)),
                        theirs = paper.cell(r, constant);
      const auto ours = number_of(used);
      table.rows.push_back({tissue, constant, used, theirs,
                            ours ? general(*ours - paper.number(r, constant)) : no_value});
    }
  }
  return table;
}

}  // namespace breast
