// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a material set to a table that load_materials can read.
#pragma once

#include "core/table.hpp"
#include "material/law.hpp"

namespace breast {

/// One row for each of fat, fibroglandular, muscle, tumour and skin, for the supports of wall and
/// cut if the set has them, and for its uncertainty if that is known. Numbers read back exactly.
Table material_table(const MaterialSet& set);

}  // namespace breast
