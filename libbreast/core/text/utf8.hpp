// SPDX-License-Identifier: GPL-3.0-or-later
// UTF-8 in text that may come from anybody (RFC 3629: no overlong forms, no surrogates).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace breast {

/// A character of a text: its number of bytes, 0 if no valid one begins there, and its code point.
struct Utf8Character {
  std::size_t bytes = 0;
  std::uint32_t code = 0;
};
/// The character with which `text` begins.
Utf8Character first_character(std::string_view text);

/// The text with bytes that are not valid UTF-8 replaced by U+FFFD.
std::string valid_utf8(std::string_view bytes);

}  // namespace breast
