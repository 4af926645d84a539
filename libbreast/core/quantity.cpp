// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/quantity.hpp"

namespace breast {

void tell(const std::vector<Quantity>& quantities, Table& table, Report& report) {
  for (const Quantity& q : quantities) {
    const bool all = q.digits == Quantity::all_digits;
    table.rows.push_back({q.name, all ? format_number(q.value) : format_fixed(q.value, q.digits)});
    report.set(q.key, q.value);
  }
}

}  // namespace breast
