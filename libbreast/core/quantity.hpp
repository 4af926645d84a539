// SPDX-License-Identifier: GPL-3.0-or-later
// Named numbers that are written to both a table and a report.
#pragma once

#include <string>
#include <vector>

#include "core/report.hpp"
#include "core/table.hpp"

namespace breast {

struct Quantity {
  static constexpr int all_digits = -1;

  std::string name;  ///< name in a table, with its unit
  std::string key;   ///< key in a report
  double value;
  int digits = all_digits;  ///< number of digits to print after the decimal point
};

/// Adds a row (name, value) for each quantity to the table, and a key for each to the report.
void tell(const std::vector<Quantity>& quantities, Table& table, Report& report);

}  // namespace breast
