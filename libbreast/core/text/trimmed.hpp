// SPDX-License-Identifier: GPL-3.0-or-later
// A text without the blanks around it.
#pragma once

#include <string>
#include <string_view>

namespace breast {

/// The text without blanks, tabs and carriage returns (vertical tabs and form feeds, too) at either
/// end.
inline std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

}  // namespace breast
