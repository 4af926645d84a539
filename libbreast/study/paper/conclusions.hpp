// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's conclusions as numbers, and whether they hold for several models.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

/// The row for a landmark and a parameter in a table of `sensitivity`; for the tumour also that of
/// an artificial tumour.
std::optional<std::size_t> slope_row_of(const Table& slopes, const std::string& landmark,
                                        const std::string& parameter);
/// The slope in that row with the given number of decimals; "-" if there is none.
std::string slope_cell(const Table& slopes, const std::string& landmark,
                       const std::string& parameter, int decimals);

// The tables have one row per conclusion: its name (pipelines/paper/conclusions.tsv) and its value,
// "-" without a solution. Values are the slopes d ln u / d ln s of nipple and tumour with respect
// to each tissue, whether their order is that of the paper, and the change in per cent caused by a
// stiff tumour.
/// From the rows of 90 and 110 per cent of Tables III, IV and V and the rows of Table VI, columns
/// PREFIXnipple_mm and PREFIXtumour_mm.
Table conclusions_from_rows(const std::array<Table, 4>& tables, const std::string& prefix);
/// From slopes written by `sensitivity --table` (no value: no solution), and from Table VI.
Table conclusions_from_slopes(const std::optional<Table>& slopes, const Table& stiff);

struct JudgedModel {
  std::string name;
  Table values;  ///< columns conclusion, value
};
/// The bounds of the conclusions, and for every model its value and verdict: holds, fails, not
/// evaluated. Throws Error (input) naming a table of values that lacks these columns.
Table judge(const Table& conclusions, const std::vector<JudgedModel>& models);

/// Tables III and VI of the paper, to which the conclusions refer.
struct PaperTables {
  Table third, sixth;
};

/// judge() applied to Tables III to VI in the folder `tables`: to the values of the paper, to our
/// values for the model as printed (tableN-as-printed.tsv, only if `printed`), and to our values
/// for the case.
Table judged_tables(const Table& conclusions, const std::filesystem::path& tables, bool printed);

/// Table VIII. The first rows state whether each set of `sets` has a stress-free body, and the
/// supine displacements of nipple and tumour; the other rows are judge() applied to the paper, to
/// RUN and to the sets, which are the variants SET and SET-tumour-PERCENT of RUN/studies/table8.
Table survival_table(const Table& conclusions, const PaperTables& paper,
                     const std::filesystem::path& run, const ShapeReader& read,
                     const std::vector<std::string>& sets, const std::string& calibrated);

}  // namespace breast
