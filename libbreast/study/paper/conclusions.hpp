// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's conclusions in numbers, and whether they hold for several models.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

/// The row of a table of `sensitivity` for a landmark (the tumour's also where it is an artificial one) and a parameter.
std::optional<std::size_t> slope_row_of(const Table& slopes, const std::string& landmark,
                                        const std::string& parameter);
/// Its slope with so many decimals, "-" without one.
std::string slope_cell(const Table& slopes, const std::string& landmark,
                       const std::string& parameter, int decimals);

// A row a conclusion: its name (pipelines/paper/conclusions.tsv) and value, "-" without a solution: slopes d ln u / d ln s of
// nipple and tumour by each tissue, whether their order is the paper's, and per cent of change by a stiff tumour.
/// From the rows of 90 and 110 per cent of Tables III, IV and V and those of Table VI, columns PREFIXnipple_mm, PREFIXtumour_mm.
Table conclusions_from_rows(const std::array<Table, 4>& tables, const std::string& prefix);
/// From slopes as `sensitivity --table` wrote them (nothing: no solution), and Table VI.
Table conclusions_from_slopes(const std::optional<Table>& slopes, const Table& stiff);

struct JudgedModel {
  std::string name;
  Table values;  ///< conclusion, value
};
/// The conclusions' bounds, and for every model its value and verdict: holds, fails, not evaluated. Throws Error (input) naming
/// a table of values without its columns.
Table judge(const Table& conclusions, const std::vector<JudgedModel>& models);

/// What the paper prints.
struct PaperTables {
  Table third, sixth;
};

/// judge() of Tables III to VI in `tables`: of the paper's own rows, as printed (tableN-as-printed.tsv, where asked for), and ours.
Table judged_tables(const Table& conclusions, const std::filesystem::path& tables, bool printed);

/// Table VIII: first whether each set of `sets` has a stress-free body and the supine displacements of nipple and tumour, then
/// judge() of the paper, of RUN and of the sets, the variants SET and SET-tumour-PERCENT of RUN/studies/table8.
Table survival_table(const Table& conclusions, const PaperTables& paper,
                     const std::filesystem::path& run, const ShapeReader& read,
                     const std::vector<std::string>& sets, const std::string& calibrated);

}  // namespace breast
