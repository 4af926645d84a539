// SPDX-License-Identifier: GPL-3.0-or-later
#include "page/script_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>

#include "core/text/base64.hpp"
#include "core/text/utf8.hpp"

namespace breast {

namespace {

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
    const auto [length, code] = first_character(rest);
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

std::string script_bytes(std::string_view bytes) {
  return '"' + base64(bytes) + '"';
}

}  // namespace breast
