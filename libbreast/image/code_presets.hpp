// SPDX-License-Identifier: GPL-3.0-or-later
// Tissues of other programs' values and names, by presets: pipelines/codes/NAME.tsv, one a program or data
// set, compiled in.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/embedded_table.hpp"
#include "core/types.hpp"

namespace breast {

struct CodePreset {
  std::map<int, Tissue> values;
  std::map<std::string, Tissue> names;  ///< as plain_name writes them
};

/// The names of the presets.
std::vector<std::string> code_preset_names();

/// A preset by its name, or a table of the same columns (value, name, tissue; "-" where there is no value or
/// no name) by its path. Throws Error (input) for neither, listing the names, and for a table that does not
/// fit.
CodePreset load_code_preset(const std::string& name_or_file);

/// The tissue that a text names: one of tissue_name, or "wall" for muscle.
std::optional<Tissue> tissue_from_text(const std::string& text);

/// A name in small letters, with single blanks instead of all else: "Chest_wall" is "chest wall". 3D Slicer
/// adds _1 to the name of a segment that was deleted and added again: without `number`, such an ending is
/// left out.
std::string plain_name(const std::string& name, bool number = true);

const std::vector<EmbeddedTable>& embedded_codes();

}  // namespace breast
