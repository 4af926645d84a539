// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/cells.hpp"

#include <cstdio>
#include <filesystem>

namespace breast {

std::string fixed_cell(std::optional<double> value, int decimals) {
  return value ? format_fixed(*value, decimals) : no_value;
}

std::string general(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

std::string cell_or_dash(const std::string& text) {
  return text.empty() ? no_value : text;
}

std::optional<double> number_of(const std::string& cell) {
  return number_in(cell.starts_with('+') ? cell.substr(1) : cell);
}

std::string cell_at(const Table& table, const std::string& row, const std::string& column) {
  std::string name = column;
  if (!table.has(name)) name = "artificial_" + column;
  if (!table.has(name)) return "";
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.rows[r].front() == row) return table.cell(r, name);
  return "";
}

std::optional<double> number_at(const Table& table, const std::string& row,
                                const std::string& column) {
  return number_of(cell_at(table, row, column));
}

std::optional<Table> table_if_any(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored) ||
      std::filesystem::file_size(file, ignored) == 0)
    return {};
  return read_table(file);
}

}  // namespace breast
