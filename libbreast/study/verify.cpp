// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/verify.hpp"

#include <cmath>
#include <sstream>

#include "core/text/lists.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace {

std::string value_of(const std::filesystem::path& file, const std::string& row,
                     const std::string& column) {
  if (file.extension() == ".json") return StageReport::read(file).text(column);
  const auto table = table_if_any(file);
  return table ? cell_at(*table, row, column) : "";
}

}  // namespace

std::string verdict_of(const std::string& expected, const std::string& computed,
                       const std::string& tolerance) {
  if (computed.empty()) return "missing";
  const auto a = number_of(expected), b = number_of(computed);
  if (a && b) return std::abs(*a - *b) <= number_of(tolerance).value_or(0) ? "ok" : "differs";
  return expected == computed ? "ok" : "differs";
}

Verification verify(const Table& expected, const std::filesystem::path& run) {
  Verification result{
      {{"file", "row", "column", "expected", "computed", "tolerance", "verdict"}, {}}, 0};
  for (std::size_t r = 0; r < expected.rows.size(); ++r) {
    const auto cell = [&](const char* column) { return expected.cell(r, column); };
    const std::string computed = value_of(run / cell("file"), cell("row"), cell("column"));
    const std::string verdict = verdict_of(cell("expected"), computed, cell("tolerance"));
    if (verdict != "ok") ++result.failed;
    result.table.rows.push_back({cell("file"), cell("row"), cell("column"), cell("expected"),
                                 cell_or_dash(computed), cell("tolerance"), verdict});
  }
  return result;
}

std::string expected_anew(const std::string& text, const std::filesystem::path& run) {
  const Verification verified = verify(parse_table(text, "expected values"), run);
  std::istringstream in(text);
  std::string written, line;
  for (std::size_t row = 0; std::getline(in, line);) {
    if (line.empty() || line.front() == '#' || line.starts_with("file\t")) {
      written += line + "\n";
      continue;
    }
    Row cells = split(line, '\t');
    const Row& found = verified.table.rows[row++];
    if (found.back() != "ok") cells[3] = found[4];
    written += join(cells, "\t") + "\n";
  }
  return written;
}

}  // namespace breast
