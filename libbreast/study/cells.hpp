// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of the tables of a study: numbers as text, "-" where there is none, and the text of reports made fit for a cell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

using Row = std::vector<std::string>;

inline const std::string no_value = "-";

/// Fixed decimals; "-" where there is no number.
std::string fixed_cell(std::optional<double> value, int decimals);
/// So many significant digits, as printf's %g.
std::string general(double value, int digits = 6);
/// The text, or "-" for an empty one.
std::string cell_or_dash(const std::string& text);
/// The number of a cell; nothing for any other text.
std::optional<double> number_of(const std::string& cell);

/// The cell in the row whose first column is `row`; also found under a column "artificial_COLUMN". "" without one.
std::string cell_at(const Table& table, const std::string& row, const std::string& column);
std::optional<double> number_at(const Table& table, const std::string& row,
                                const std::string& column);
/// The table in `file`; nothing where it is absent or empty.
std::optional<Table> table_if_any(const std::string& file);

/// Tabs and line breaks as blanks.
std::string one_line(std::string text);
/// Bytes that are no UTF-8 as U+FFFD.
std::string valid_utf8(const std::string& bytes);
/// `parts` with `between` between them.
std::string join(const std::vector<std::string>& parts, const std::string& between);
/// The pieces between the separators; one empty piece of an empty text.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace breast
