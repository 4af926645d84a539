// SPDX-License-Identifier: GPL-3.0-or-later
// Summaries of studies with many solves, one row for each kind of case.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Summarises the rows of identification_study, one row per study, truth and mesh: means over the draws;
/// the number of directions in the space of parameters that the data determine to within 5 %, and the
/// percentages of these directions in which the result lies within 10 % of the truth and within two
/// standard deviations of it; the latter percentage for all directions;
/// and the percentage of draws in which the misfit test at 5 % indicates another model.
Table identification_table(const std::vector<Table>& studies);

/// One page with the tables of extreme cases. A row for every direction (for compression only one)
/// and outcome gives the number of cases, their worst values, the total seconds, and the names of
/// the cases that did not converge or ended otherwise than their case specifies.
Table stability_table(const Table& mechanics, const Table& contact);

}  // namespace breast
