// SPDX-License-Identifier: GPL-3.0-or-later
// A text that fits into one line or one cell of a table.
#pragma once

#include <algorithm>
#include <string>

namespace breast {

/// The text with tabs and line breaks replaced by blanks.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

}  // namespace breast
