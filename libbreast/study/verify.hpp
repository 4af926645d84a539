// SPDX-License-Identifier: GPL-3.0-or-later
// A run against expected values.
#pragma once

#include <filesystem>
#include <string>

#include "core/table.hpp"

namespace breast {

/// "ok", "differs", or "missing" where `computed` is empty: numbers within `tolerance`, other texts equal.
std::string verdict_of(const std::string& expected, const std::string& computed,
                       const std::string& tolerance);

struct Verification {
  Table table;  ///< file, row, column, expected, computed, tolerance, verdict
  int failed = 0;
};
/// Rows of `expected`: file (below RUN), row (value of the file's first column; "-" for a report), column (or key of a .json
/// report), expected, tolerance.
Verification verify(const Table& expected, const std::filesystem::path& run);
/// The text of a table of expected values with the run's values where they differ; what agrees keeps its value, so that a bound
/// stays a bound, and comments stay.
std::string expected_anew(const std::string& text, const std::filesystem::path& run);

}  // namespace breast
