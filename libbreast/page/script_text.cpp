// SPDX-License-Identifier: GPL-3.0-or-later
#include "page/script_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>

namespace breast {

namespace {

// Length of the UTF-8 character at the beginning, with its code; 0 if the bytes are not a valid
// character.
std::size_t front_character(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::size_t length = byte(0) < 0x80       ? 1
                             : byte(0) >> 5 == 6  ? 2
                             : byte(0) >> 4 == 14 ? 3
                             : byte(0) >> 3 == 30 ? 4
                                                  : 0;
  if (length == 0 || length > text.size()) return 0;
  constexpr unsigned char bits[] = {0x7f, 0x7f, 0x1f, 0x0f, 0x07};
  code = byte(0) & bits[length];
  for (std::size_t k = 1; k < length; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    code = code << 6 | (byte(k) & 0x3f);
  }
  return code < 0x110000 ? length : 0;
}

std::string escaped(std::uint32_t unit) {
  constexpr const char* digits = "0123456789abcdef";
  std::string out = "\\u";
  for (int shift = 12; shift >= 0; shift -= 4) out += digits[unit >> shift & 15];
  return out;
}

}  // namespace

std::string script_text(const std::string& text) {
  std::string out = "\"";
  for (std::string_view rest = text; !rest.empty();) {
    constexpr std::uint32_t replacement = 0xfffd, first_pair = 0x10000;
    std::uint32_t code = 0;
    const std::size_t length = front_character(rest, code);
    const char c = rest[0];
    if (length == 0) {
      out += escaped(replacement);
    } else if (code >= first_pair) {
      out += escaped(0xd800 + ((code - first_pair) >> 10)) +
             escaped(0xdc00 + ((code - first_pair) & 0x3ff));
    } else if (code < 0x80 && (std::isalnum(static_cast<unsigned char>(c)) ||
                               std::string_view(" -_.,:+()").find(c) != std::string_view::npos)) {
      out += c;
    } else {
      out += escaped(code);
    }
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out + '"';
}

std::string script_bytes(std::span<const unsigned char> bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "\"";
  text.reserve(4 * ((bytes.size() + 2) / 3) + 2);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return i + k < bytes.size() ? unsigned(bytes[i + k]) : 0u;
    };
    const unsigned three = at(0) << 16 | at(1) << 8 | at(2);
    for (int k = 0; k < 4; ++k) {
      text += i + std::size_t(k) < bytes.size() + 1 ? digits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text + '"';
}

}  // namespace breast
