// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a material set to a table that load_materials can read.
#pragma once

#include "core/table.hpp"
#include "material/law.hpp"

namespace breast {

/// One row for each of fat, fibroglandular, muscle, tumour and skin, and of air and other tissue if
/// they differ from fat, whose law and density a set without their row gives them; rows for the
/// supports of wall and cut if the set has them, and for its uncertainty if that is known. Numbers
/// read back exactly.
Table material_table(const MaterialSet& set);

/// The number of per cent that, divided by 100, reads back as this fraction.
std::string percent_text(double fraction);

}  // namespace breast
