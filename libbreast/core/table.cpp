// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"

namespace breast {

namespace {
bool is_non_finite(const std::string& cell) {
  double value = 0;
  const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool number = end.ec == std::errc() && end.ptr == cell.data() + cell.size();
  return number && !std::isfinite(value);
}
// The text of a cell in a file. In a table of one column an empty cell would be an empty line,
// which is skipped when the table is read; it is therefore written as "-".
std::string written_cell(const std::string& cell, std::size_t columns) {
  return cell == empty_cell && columns > 1 ? "" : cell;
}
// Refused in every column, also in one that is not used: no table written by libbreast has such a
// cell.
void refuse_non_finite(const std::string& cell, const std::string& where) {
  if (is_non_finite(cell)) throw input_error(where, ": '", cell, "' is not finite");
}
// What is read from `text` must be the table: a tab or line break in a name, or a name that begins
// with '#', would otherwise move or drop cells without a word.
void check_reads_back(const Table& table, const std::string& text) {
  std::string reason = "its rows or columns change";
  try {
    const Table read = parse_table(text, table.name);
    if (read.columns == table.columns && read.rows == table.rows) return;
    const auto [ours, theirs] =
        std::mismatch(table.rows.begin(), table.rows.end(), read.rows.begin(), read.rows.end());
    if (ours != table.rows.end() && !ours->empty()) {
      reason = message("row ", ours - table.rows.begin() + 1, ", '", ours->front(),
                       "', reads back as another");
    }
  } catch (const Error& error) {
    reason = error.what();
  }
  throw failed_error(table.name, ": cannot be written as tab-separated text (", reason,
                     "): names in a table must not contain tabs or line breaks, nor begin a row "
                     "with #");
}
}  // namespace

int Table::column(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found != columns.end()) return int(found - columns.begin());
  std::string known;
  for (const std::string& c : columns) known += (known.empty() ? "" : ", ") + c;
  throw input_error(name, " has no column '", column, "'; it has: ", known);
}

bool Table::has(const std::string& column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

const std::string& Table::cell(std::size_t row, const std::string& column) const {
  return rows[row][std::size_t(this->column(column))];
}

double Table::number(std::size_t row, const std::string& column) const {
  return parse_number(cell(row, column), message(name, ", row ", row + 1, ", ", column));
}

Vec3 Table::point(std::size_t row, const std::string& prefix) const {
  const auto along = [&](const char* axis) {
    const std::string bare = prefix + axis;
    return number(row, has(bare) ? bare : bare + "_mm");
  };
  const Vec3 point(along("x"), along("y"), along("z"));
  constexpr double farthest_mm = 1e6;
  if (!(point.cwiseAbs().maxCoeff() <= farthest_mm)) {
    throw input_error(name, ", row ", row + 1, ": ", point.transpose(), " mm, must be within ",
                      farthest_mm);
  }
  return point;
}

std::string Table::text() const {
  Table written = *this;
  for (auto& row : written.rows)
    for (std::string& cell : row)
      if (cell.empty() || is_non_finite(cell)) cell = empty_cell;
  std::string out = join(columns, "\t") + "\n";
  for (std::vector<std::string> row : written.rows) {
    for (std::string& cell : row) cell = written_cell(cell, columns.size());
    out += join(row, "\t") + "\n";
  }
  check_reads_back(written, out);
  return out;
}

std::string Table::closed_text() const {
  return text() + std::string(table_end);
}

bool closes_table(std::string_view tail) {
  return tail.ends_with("\n\r\n") && !tail.ends_with("\r\n\r\n");
}

Table parse_table(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  Table table;
  table.name = name;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells = split(line, '\t');
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns.size()) {
      throw input_error(name, ": line ", number, " has ", cells.size(), " columns, the header has ",
                        table.columns.size());
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      refuse_non_finite(cells[c], message(name, ": line ", number, ", ", table.columns[c]));
      if (cells[c].empty()) cells[c] = empty_cell;
    }
    table.rows.push_back(std::move(cells));
  }
  if (table.columns.empty()) throw input_error(name, ": no header line");
  table.closed = closes_table(text);
  return table;
}

Table read_table(const std::filesystem::path& file) {
  // A table of tabs needs 32 bytes of memory per byte.
  constexpr std::uintmax_t most_bytes = 16 << 20;
  return parse_table(read_text(file, most_bytes), file.string());
}

void write_table(const std::filesystem::path& file, const Table& table) {
  write_text(file, table.closed_text());
}

std::string format_number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

std::string format_fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !(value - value == 0)) {
    return {};
  }
  return value;
}

double parse_number(const std::string& text, const std::string& where) {
  const std::optional<double> value = number_in(text);
  if (!value) throw input_error(where, ": '", text, "' is not a finite number");
  return *value;
}

}  // namespace breast
