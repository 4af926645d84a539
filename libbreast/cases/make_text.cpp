// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/make_text.hpp"

#include <algorithm>

#include "cli/declaration.hpp"
#include "core/error.hpp"

namespace breast {

std::string make_assignment(const std::string& name, const std::string& value) {
  return name + " := " + value + make_line_end;
}

std::string make_addition(const std::string& name, const std::string& value) {
  return name + " += " + value + make_line_end;
}

std::string rows_for_make(const Table& table, const std::string& name) {
  std::string text;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (const std::string& column : table.columns) {
      const std::string& cell = table.cell(r, column);
      if (!code_in(cell).empty())
        throw input_error(table.name, ": the cell '", cell, "' of the column ", column,
                          " contains the character ", code_in(cell),
                          ", which make would read as code; write it without this character");
      text += make_assignment("cell_" + column, cell == empty_cell ? "" : cell);
    }
    text += "$(eval $(value " + name + "))" + make_line_end;
  }
  return text;
}

std::string code_in(const std::string& text) {
  const std::size_t at = text.find_first_of("$`;&|<>(){}[]*?!\"'\\^#");
  return at == std::string::npos ? "" : text.substr(at, 1);
}

bool has_control(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const auto upper = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
      return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : char(c);
    });
    return text;
  };
  std::vector<std::string> raised;
  for (const std::string& candidate : candidates) raised.push_back(upper(candidate));
  const std::string near = nearest(upper(word), raised);
  const auto found = std::find(raised.begin(), raised.end(), near);
  return near.empty() ? ""
                      : "; did you mean " + candidates[std::size_t(found - raised.begin())] + "?";
}

}  // namespace breast
