// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a material set to a table that load_materials can read.
#pragma once

#include "core/table.hpp"
#include "material/law.hpp"

namespace breast {

/// A row for each of fat, fibroglandular, muscle, tumour and skin, for the supports of wall and cut
/// where the set has them, and for what is known of its uncertainty. Numbers read back exactly.
Table material_table(const MaterialSet& set);

}  // namespace breast
