// SPDX-License-Identifier: GPL-3.0-or-later
// The material tables compiled into the library (generated from pipelines/materials/*.tsv).
#pragma once

#include <string_view>
#include <vector>

namespace breast {

struct EmbeddedTable {
  std::string_view name, text;
};
const std::vector<EmbeddedTable>& embedded_materials();

}  // namespace breast
