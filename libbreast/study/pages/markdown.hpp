// SPDX-License-Identifier: GPL-3.0-or-later
// Generation of tables in the pages of docs/, and checks of the numbers that these pages state.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Tab-separated text as a Markdown table.
std::string markdown_table(const std::string& tsv, const std::string& name);
/// The page with the contents of FILE (tab-separated) as Markdown between its lines `<!-- table
/// FILE -->` and `<!-- end of table -->`. Throws Error (input) naming the page if a table has no
/// end, or naming the table if it has no row.
std::string with_tables(const std::string& page, const std::string& name,
                        const std::function<std::string(const std::string& file)>& read);

/// Errors against the truth as the pages show them: mean, largest, nipple and true tumour.
Table truth_summary(const Table& truth);

/// One sentence for every row of docs/numbers.tsv in which the number in the page differs from that
/// in its source. Patterns are extended regular expressions with one group, the number; a source
/// may be a folder.
std::vector<std::string> wrong_numbers(const Table& numbers);

}  // namespace breast
