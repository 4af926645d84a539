// SPDX-License-Identifier: GPL-3.0-or-later
// The section of a report that puts one breast's motion beside that of living women.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// HTML of the motion from prone to supine in `run`/population.tsv (of the tool population, mm) with its figure; empty
/// where there is no such table, as for a breast whose chest wall is held.
std::string motion_section(const std::filesystem::path& run);

}  // namespace breast
