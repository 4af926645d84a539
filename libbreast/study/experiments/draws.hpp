// SPDX-License-Identifier: GPL-3.0-or-later
// Studies of many solves, a row a kind: what became of them.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Judges the rows of identification_study: one row a study, truth and mesh. Means over its draws; directions known to 5 % and how
/// many of them meet the truth within 10 % and within two deviations, all directions within two deviations, per cent of
/// draws that the misfit test at 5 % takes for another model.
Table identification_table(const std::vector<Table>& studies);

/// One page of the tables of extreme cases: a row a direction (compression: one) and outcome: how many cases, the worst of what
/// they say, the seconds of all, and the names of those that did not converge or ended otherwise than their case states.
Table stability_table(const Table& mechanics, const Table& contact);

}  // namespace breast
