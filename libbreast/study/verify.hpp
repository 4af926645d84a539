// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of a run with expected values.
#pragma once

#include <filesystem>
#include <string>

#include "core/table.hpp"

namespace breast {

/// "ok", "differs", or "missing" if `computed` is empty. Numbers must agree within `tolerance`,
/// other text must be equal.
std::string verdict_of(const std::string& expected, const std::string& computed,
                       const std::string& tolerance);

struct Verification {
  Table table;  ///< columns file, row, column, expected, computed, tolerance, verdict
  int failed = 0;
};
/// Compares the rows of `expected`, which has the columns file (in the folder RUN), row (value in
/// the file's first column; "-" for a report), column (or key of a .json report), expected and
/// tolerance.
Verification verify(const Table& expected, const std::filesystem::path& run);
/// The text of a table of expected values, with the values of the run in rows that differ. Rows
/// that agree keep their value, so that a bound remains a bound, and comments are kept.
std::string expected_anew(const std::string& text, const std::filesystem::path& run);

}  // namespace breast
