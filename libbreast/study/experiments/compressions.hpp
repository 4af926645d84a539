// SPDX-License-Identifier: GPL-3.0-or-later
// Breasts between plates: what the reports of `compress` state about them, one row each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

/// One row per report CASE/VIEW.json of `compress`, named by its folder: thickness in mm, forces in
/// N, area in cm², pressure in kPa, shares of force, volume and gland in per cent.
Table compressions_table(const std::vector<std::filesystem::path>& reports);

/// One row per view (cc, mlo) and variant FOLDER/VARIANT, without variants that have no report of
/// the view. tumour_mm and nipple_mm are the distances of these landmarks from their positions in
/// the variant `base`, or in the next variant of the list if `base` is "next"; "-" where either
/// variant has no shape.
Table plates_table(const std::filesystem::path& folder, const std::string& base,
                   const std::vector<std::string>& variants, const ShapeReader& read);

}  // namespace breast
