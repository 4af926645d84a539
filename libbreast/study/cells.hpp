// SPDX-License-Identifier: GPL-3.0-or-later
// Formatting and reading of table cells in a study: numbers as text, "-" for a missing value, and
// text from reports in a form that fits into a cell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

using Row = std::vector<std::string>;

inline const std::string no_value = "-";

/// The value with a fixed number of decimals; "-" if there is no value.
std::string fixed_cell(std::optional<double> value, int decimals);
/// The value with the given number of significant digits, as printf's %g.
std::string general(double value, int digits = 6);
/// The text, or "-" if it is empty.
std::string cell_or_dash(const std::string& text);
/// The number in a cell; no value for any other text.
std::optional<double> number_of(const std::string& cell);

/// The cell of `column` in the row with `row` in its first column; a column "artificial_COLUMN" is
/// found as well. "" if there is none.
std::string cell_at(const Table& table, const std::string& row, const std::string& column);
std::optional<double> number_at(const Table& table, const std::string& row,
                                const std::string& column);
/// The table in `file`; no value if the file is absent or empty.
std::optional<Table> table_if_any(const std::string& file);

}  // namespace breast
