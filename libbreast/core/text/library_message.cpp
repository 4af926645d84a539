// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/text/library_message.hpp"

#include <cctype>
#include <regex>

namespace breast {

std::string library_message(const std::string& text) {
  constexpr std::size_t longest = 200;
  static const std::regex title(R"(itk::ERROR:\s*)"),
      object(R"([A-Za-z0-9_:]*\s?\(0x[0-9a-fA-F]+\):?\s*)"), address(R"(0x[0-9a-fA-F]{6,})");
  std::string said = std::regex_replace(text, title, "");
  said = std::regex_replace(said, object, "");
  said = std::regex_replace(said, address, "?");
  std::string line;
  for (const char c : said) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (blank && (line.empty() || line.back() == ' ')) continue;
    line += blank ? ' ' : c;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line.substr(0, longest);
}

}  // namespace breast
