// SPDX-License-Identifier: GPL-3.0-or-later
// The error budget: what is left of the errors when one stage is replaced by the truth, and what that stage costs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// A row for the chain and every row of RUN/budget/ROW: mean and largest error, mm, of the truth's places in the stress-free
/// and supine shapes (landmarks.tsv), and of their MLO places from the curve (curves.tsv: mean, 95 %, largest); CPU seconds
/// of the chain's own stages that the row replaces (chain: all); missing: why a cell is "-".
Table budget_table(const std::filesystem::path& run, const std::vector<std::string>& rows);

}  // namespace breast
