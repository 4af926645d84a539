// SPDX-License-Identifier: GPL-3.0-or-later
// How far each side of a cohort gets from the scan to the supine shape, and how well.
#pragma once

#include <filesystem>
#include <vector>

#include "core/table.hpp"
#include "study/cohort/cohort_table.hpp"

namespace breast {

/// One row per case, in the order of `cases`: the last stage reached; what was mended; agreement of the
/// labels with the truth (labels-truth.tsv, where the case has one) and the wall's own uncertainty; distance of
/// the skin's fit; worst scaled Jacobian; volume within the rim; CPU seconds and memory of all stages;
/// and the reason why the case ended.
Table side_table(const std::filesystem::path& runs, const std::vector<CohortCase>& cases);

}  // namespace breast
