// SPDX-License-Identifier: GPL-3.0-or-later
// What became of every stage of a study's variants.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

/// A row a report FOLDER/VARIANT/STAGE.json: its status, why it ended early, elements, CPU seconds, and for a shape that was
/// found how far its landmarks are from their imaged places, mm.
Table outcomes_table(const std::filesystem::path& folder, const std::vector<std::string>& landmarks,
                     const std::vector<std::string>& variants, const ShapeReader& read);

}  // namespace breast
