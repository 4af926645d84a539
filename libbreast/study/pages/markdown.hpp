// SPDX-License-Identifier: GPL-3.0-or-later
// Generated tables in the pages of docs/, and the numbers these pages state.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// A table as Markdown.
std::string markdown_table(const std::string& tsv, const std::string& name);
/// The page with FILE (tab-separated) as Markdown between its lines `<!-- table FILE -->` and `<!-- end of table -->`. Throws Error
/// (input) naming the page where a table has no end, or the table that holds no row.
/// Below each table stands what `run_of` says of the run that made it.
std::string with_tables(const std::string& page, const std::string& name,
                        const std::function<std::string(const std::string& file)>& read,
                        const std::function<std::string(const std::string& file)>& run_of);

/// What docs/tables/runs.tsv (table, date, commit, machine) says of the run that made a table: one line; that nothing was recorded
/// where it has no row, or no cell.
std::string run_line(const Table& runs, const std::string& file);
/// The same with the row of `file` set.
Table with_run(const Table& runs, const std::string& file, const std::string& date,
               const std::string& commit, const std::string& machine);

/// Errors against the truth, as the page shows them: mean, largest, nipple and the true tumour.
Table truth_summary(const Table& truth);
/// The chains' errors against their phantoms' truth, a row a posture of every run: means and largest over the landmarks, how far the
/// truth moved from the scan, the chain's error, the same in per cent of the motion, and the truth's own error. Of RUN's
/// truth-compressed.tsv, or truth.tsv where nothing was compressed.
Table truth_of_postures(const std::vector<std::filesystem::path>& runs);

/// Rows of docs/numbers.tsv whose number is another in the page than in its source, a sentence each. Patterns are extended
/// regular expressions whose one group is the number; a source may be a folder.
std::vector<std::string> wrong_numbers(const Table& numbers);

}  // namespace breast
