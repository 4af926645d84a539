// Tab-separated tables with units in the header ("nipple_mm").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  int column(const std::string& name) const;  ///< throws Error (input) naming the columns there are
  std::string text() const;
};
/// Lines starting with '#' are comments. Throws Error (input) with the line number, also for a cell
/// that is nan or inf.
Table read_table(const std::filesystem::path& file);
/// The same from text; `name` is used in errors.
Table parse_table(const std::string& text, const std::string& name);
void write_table(const std::filesystem::path& file, const Table& table);
/// Shortest text that reads back to the same double.
std::string format_number(double value);
/// Strict: the whole text must be one finite number; throws Error (input) beginning with `where`.
double parse_number(const std::string& text, const std::string& where);
/// Fixed decimals for people.
std::string format_fixed(double value, int decimals);

}  // namespace breast
