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
/// FILE -->` and `<!-- end of table -->`. Below each table stands the line that `run_of` returns
/// about the run that made it. Throws Error (input) naming the page if a table has no end, or
/// naming the table if it has no row.
std::string with_tables(const std::string& page, const std::string& name,
                        const std::function<std::string(const std::string& file)>& read,
                        const std::function<std::string(const std::string& file)>& run_of);

/// One line about the run that made the table `file`: date, commit and machine, as recorded in
/// `runs` (docs/tables/runs.tsv). The line says so if no run is recorded, or if the table is not
/// from a run.
std::string run_line(const Table& runs, const std::string& file);
/// A copy of `runs` with these values in the row of `file`, which is added if it does not exist.
/// The rows are sorted by the name of the table.
Table with_run(const Table& runs, const std::string& file, const std::string& date,
               const std::string& commit, const std::string& machine);

/// Errors against the truth as the pages show them: mean, largest, nipple and true tumour.
Table truth_summary(const Table& truth);
/// Errors of the chains against the truth of their phantoms, with one row per run and posture.
/// Columns: mean displacement of the true landmarks from the scan, mm; mean and largest error of
/// the chain, mm; mean error in per cent of that displacement; mean and largest error of the truth
/// itself, mm. The values are read from RUN/truth-compressed.tsv, or from RUN/truth.tsv if nothing
/// was compressed.
Table truth_of_postures(const std::vector<std::filesystem::path>& runs);

/// One sentence for every row of docs/numbers.tsv in which the number in the page differs from that
/// in its source. Patterns are extended regular expressions with one group, the number; a source
/// may be a folder.
std::vector<std::string> wrong_numbers(const Table& numbers);

}  // namespace breast
