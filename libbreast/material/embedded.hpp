// SPDX-License-Identifier: GPL-3.0-or-later
// The material tables compiled into the library (generated from pipelines/materials/*.tsv).
#pragma once

#include <vector>

#include "core/embedded_table.hpp"

namespace breast {

const std::vector<EmbeddedTable>& embedded_materials();

}  // namespace breast
