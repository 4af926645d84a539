// SPDX-License-Identifier: GPL-3.0-or-later
// The words of a text.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace breast {

/// The words of a text, which blanks, tabs and line breaks separate.
inline std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace breast
