// SPDX-License-Identifier: GPL-3.0-or-later
// Generation of tables in the pages of docs/, and checks of the numbers that these pages state.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Tab-separated text as a Markdown table.
std::string markdown_table(const std::string& tsv, const std::string& name);
/// The page with the contents of FILE (tab-separated) as Markdown between its lines `<!-- table
/// FILE -->` and `<!-- end of table -->`, and below each table what `run_of` says of the run that
/// made it. Throws Error (input) naming the page if a table has no end, or naming the table if it
/// has no row.
std::string with_tables(const std::string& page, const std::string& name,
                        const std::function<std::string(const std::string& file)>& read,
                        const std::function<std::string(const std::string& file)>& run_of);

/// What docs/tables/runs.tsv (table, date, commit, machine) says of the run that made a table: one line; that nothing was recorded
/// where it has no row, or no cell.
std::string run_line(const Table& runs, const std::string& file);
/// The same with the row of `file` set.
Table with_run(const Table& runs, const std::string& file, const std::string& date,
               const std::string& commit, const std::string& machine);

/// Errors against the truth as the pages show them: mean, largest, nipple and true tumour.
Table truth_summary(const Table& truth);
/// The chains' errors against their phantoms' truth, a row a posture of every run: means and largest over the landmarks, how far the
/// truth moved from the scan, the chain's error, the same in per cent of the motion, and the truth's own error. Of RUN's
/// truth-compressed.tsv, or truth.tsv where nothing was compressed.
Table truth_of_postures(const std::vector<std::filesystem::path>& runs);

/// One sentence for every row of docs/numbers.tsv in which the number in the page differs from that
/// in its source. Patterns are extended regular expressions with one group, the number; a source
/// may be a folder.
std::vector<std::string> wrong_numbers(const Table& numbers);

}  // namespace breast
