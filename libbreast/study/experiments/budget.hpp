// SPDX-License-Identifier: GPL-3.0-or-later
// The error budget: the remaining errors when one stage is replaced by the truth, and the cost of
// that stage.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// One row for the chain and for every RUN/budget/ROW. Columns: mean and largest error in mm of the
/// true positions in the stress-free and supine shapes (landmarks.tsv); distance of their MLO
/// positions from the curve (curves.tsv: mean, 95 %, largest); CPU seconds of the chain's own
/// stages that the row replaces (for the chain: of all stages); missing: the reason why a cell is
/// "-".
Table budget_table(const std::filesystem::path& run, const std::vector<std::string>& rows);

}  // namespace breast
