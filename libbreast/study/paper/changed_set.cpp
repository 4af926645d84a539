// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/paper/changed_set.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace {

std::vector<std::string>& row_of(Table& set, const std::string& tissue) {
  const std::size_t column = std::size_t(set.column("tissue"));
  const auto found = std::find_if(set.rows.begin(), set.rows.end(),
                                  [&](const auto& row) { return row[column] == tissue; });
  if (found == set.rows.end())
    throw input_error(set.name, ": has no row for the tissue ", tissue,
                      ", which this change needs; add one, or use a set that has it (seed2008)");
  return *found;
}

}  // namespace

Table changed_set(const Table& set, const std::string& change) {
  Table changed = set;
  if (change == "fat-only") {
    std::vector<std::string>& gland = row_of(changed, "fibroglandular");
    gland = row_of(changed, "fat");
    gland[std::size_t(changed.column("tissue"))] = "fibroglandular";
  } else if (change == "columns") {
    const std::size_t first = std::size_t(set.column("a20_Pa")),
                      second = std::size_t(set.column("a02_Pa")),
                      third = std::size_t(set.column("a11_Pa"));
    for (std::size_t r = 0; r < set.rows.size(); ++r) {
      changed.rows[r][third] = set.rows[r][first];
      changed.rows[r][first] = set.rows[r][second];
      changed.rows[r][second] = set.rows[r][third];
    }
  } else {
    throw input_error("'", change, "' is not a change of a material set; give fat-only or columns");
  }
  return changed;
}

}  // namespace breast
