// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/code_presets.hpp"

#include <cctype>
#include <filesystem>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"

namespace breast {

namespace {

CodePreset preset_of(const Table& table) {
  CodePreset preset;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string where = table.name + ", row " + std::to_string(row + 1);
    const std::string &value = table.cell(row, "value"), &name = table.cell(row, "name");
    const std::optional<Tissue> tissue = tissue_from_text(table.cell(row, "tissue"));
    if (!tissue) throw input_error(where, ": '", table.cell(row, "tissue"), "' is not a tissue");
    if (value != "-") {
      const double code = table.number(row, "value");
      if (!(code >= 0 && code <= 65535 && code == double(int(code))))
        throw input_error(where, ": value ", value, " must be a whole number from 0 to 65535");
      preset.values[int(code)] = *tissue;
    }
    if (name != "-") preset.names[plain_name(name)] = *tissue;
  }
  return preset;
}

}  // namespace

std::vector<std::string> code_preset_names() {
  std::vector<std::string> names;
  for (const EmbeddedTable& table : embedded_codes()) names.emplace_back(table.name);
  return names;
}

CodePreset load_code_preset(const std::string& name_or_file) {
  for (const EmbeddedTable& table : embedded_codes()) {
    if (table.name == name_or_file)
      return preset_of(parse_table(std::string(table.text), name_or_file));
  }
  if (!std::filesystem::is_regular_file(name_or_file)) {
    throw input_error("--code: '", name_or_file,
                      "' is not NUMBER=TISSUE, TISSUE=NUMBER or NAME=TISSUE (such as "
                      "29=fibroglandular or wall=3), not a file, and none of the presets ",
                      join(code_preset_names(), ", "));
  }
  return preset_of(read_table(name_or_file));
}

std::optional<Tissue> tissue_from_text(const std::string& text) {
  if (text == "wall") return Tissue::muscle;
  for (int n = 0; n < n_tissues; ++n) {
    if (text == tissue_name(Tissue(n))) return Tissue(n);
  }
  return std::nullopt;
}

std::string plain_name(const std::string& name, bool number) {
  std::string text;
  for (const char c : name) {
    const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (letter) text += char(std::tolower(static_cast<unsigned char>(c)));
    if (!letter && !text.empty() && text.back() != ' ') text += ' ';
  }
  while (text.ends_with(' ')) text.pop_back();
  if (number) return text;
  const std::size_t last = text.find_last_not_of("0123456789");
  const bool ends_so = last != std::string::npos && last + 1 < text.size() && text[last] == ' ';
  return ends_so ? text.substr(0, last) : text;
}

}  // namespace breast
