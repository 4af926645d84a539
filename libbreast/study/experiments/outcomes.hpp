// SPDX-License-Identifier: GPL-3.0-or-later
// The outcome of every stage in the variants of a study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

/// One row per report FOLDER/VARIANT/STAGE.json: its status, the reason if it ended early,
/// elements, CPU seconds and, if a shape was found, the distance of its landmarks from their imaged
/// positions in mm.
Table outcomes_table(const std::filesystem::path& folder, const std::vector<std::string>& landmarks,
                     const std::vector<std::string>& variants, const ShapeReader& read);

}  // namespace breast
