// SPDX-License-Identifier: GPL-3.0-or-later
// A text in small letters.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace breast {

/// The text with its capital letters (of ASCII) as small ones.
inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

}  // namespace breast
