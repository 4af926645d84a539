// SPDX-License-Identifier: GPL-3.0-or-later
// Tab-separated tables with units in the header ("nipple_mm").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::string name = "table";  ///< of the file it came from, for errors
  bool closed = false;  ///< true if read with its closing line, so that nothing was truncated

  /// Index of a column; throws Error (input) beginning with the table's name and listing the
  /// existing columns if there is none.
  int column(const std::string& column) const;
  bool has(const std::string& column) const;
  const std::string& cell(std::size_t row, const std::string& column) const;
  /// A cell that must be a number; throws Error (input) naming table, row (from 1) and column.
  double number(std::size_t row, const std::string& column) const;
  /// The numbers of the columns PREFIXx_mm, PREFIXy_mm and PREFIXz_mm (or without _mm), mm.
  Vec3 point(std::size_t row, const std::string& prefix) const;
  std::string text() const;         ///< throws Error (failed) naming a row that would read back
                                    ///< differently
  std::string closed_text() const;  ///< text() and table_end, as in every file we write
};
/// The last line of a table written by libbreast. It is empty, so that other programs skip it, and
/// it is the only line of the file that ends with CR LF, so that a table truncated at the end of
/// another line is recognised, too.
inline constexpr std::string_view table_end = "\r\n";
/// True if `tail`, the end of a file, is the closing line of a table.
bool closes_table(std::string_view tail);
/// A cell without a value, as a Table contains it. In a file the cell is empty, which other
/// programs read as a missing number; "-", which people write, is read as the same.
inline constexpr std::string_view empty_cell = "-";

/// Reads a table. Lines starting with '#' are comments. Throws Error (input) with the line number, also
/// for a cell that is nan or inf.
Table read_table(const std::filesystem::path& file);
/// The same from a text; `name` is used in errors.
Table parse_table(const std::string& text, const std::string& name);
void write_table(const std::filesystem::path& file, const Table& table);
/// Shortest text that reads back to the same double.
std::string format_number(double value);
/// The whole text as one finite number; no value for any other text.
std::optional<double> number_in(const std::string& text);
/// The same; throws Error (input) beginning with `where`.
double parse_number(const std::string& text, const std::string& where);
/// The value with a fixed number of decimals, for display.
std::string format_fixed(double value, int decimals);

}  // namespace breast
