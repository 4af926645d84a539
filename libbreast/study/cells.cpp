// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/cells.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace breast {

std::string fixed_cell(std::optional<double> value, int decimals) {
  return value ? format_fixed(*value, decimals) : no_value;
}

std::string general(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

std::string cell_or_dash(const std::string& text) {
  return text.empty() ? no_value : text;
}

std::optional<double> number_of(const std::string& cell) {
  return number_in(cell.starts_with('+') ? cell.substr(1) : cell);
}

std::string cell_at(const Table& table, const std::string& row, const std::string& column) {
  std::string name = column;
  if (!table.has(name)) name = "artificial_" + column;
  if (!table.has(name)) return "";
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.rows[r].front() == row) return table.cell(r, name);
  return "";
}

std::optional<double> number_at(const Table& table, const std::string& row,
                                const std::string& column) {
  return number_of(cell_at(table, row, column));
}

std::optional<Table> table_if_any(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored) ||
      std::filesystem::file_size(file, ignored) == 0)
    return {};
  return read_table(file);
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

namespace {

// Number of bytes of the character that begins at `at`; 0 if there is no valid one (RFC 3629: no
// overlong forms, no surrogates).
std::size_t character(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto follows = [&](std::size_t count) {
    for (std::size_t i = 1; i <= count; ++i)
      if ((byte(at + i) & 0xC0u) != 0x80u) return false;
    return true;
  };
  const unsigned first = byte(at), second = byte(at + 1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF && follows(1)) return 2;
  if (first >= 0xE0 && first <= 0xEF && follows(2) && !(first == 0xE0 && second < 0xA0) &&
      !(first == 0xED && second > 0x9F))
    return 3;
  if (first >= 0xF0 && first <= 0xF4 && follows(3) && !(first == 0xF0 && second < 0x90) &&
      !(first == 0xF4 && second > 0x8F))
    return 4;
  return 0;
}

}  // namespace

std::string valid_utf8(const std::string& bytes) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = character(bytes, at);
    text += length == 0 ? "\xEF\xBF\xBD" : bytes.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return text;
}

std::string join(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : between) + parts[i];
  return text;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace breast
