// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pages/html.hpp"

#include <algorithm>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/text/base64.hpp"
#include "core/text/lists.hpp"
#include "core/text/utf8.hpp"
#include "study/cells.hpp"

namespace breast {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string page_head(const std::string& title, const std::string& style) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta http-equiv=\"Content-Security-Policy\" "
         "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n<title>" +
         escaped(title) + "</title>\n<style>\n" + style + "</style></head><body>\n";
}

namespace {

bool stands_out(const std::string& cell) {
  return cell == "fails" || cell == "differs" || cell == "missing" || cell == "failed";
}
bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("-+0123456789.eE") == std::string::npos;
}

}  // namespace

std::string html_table(const std::string& tsv) {
  std::istringstream in(tsv);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line == "\r" || line.starts_with('#')) continue;
    Row cells = split(line, '\t');
    if (text.empty()) {
      text = "<table><tr>\n";
      for (std::string& cell : cells) {
        std::replace(cell.begin(), cell.end(), '_', ' ');
        text += "<th>" + escaped(cell) + "</th>\n";
      }
      text += "</tr>\n";
      continue;
    }
    text += "<tr>";
    for (const std::string& cell : cells)
      text += std::string(stands_out(cell)  ? "<td class=bad>"
                          : is_number(cell) ? "<td class=n>"
                                            : "<td>") +
              escaped(cell) + "</td>";
    text += "</tr>\n";
  }
  return text.empty() ? text : text + "</table>\n";
}

std::string html_table_of(const std::filesystem::path& file) {
  return std::filesystem::is_regular_file(file) ? html_table(read_text(file)) : "";
}

std::string html_figure(const std::filesystem::path& png, const std::string& caption) {
  if (!std::filesystem::is_regular_file(png) || std::filesystem::file_size(png) == 0) return "";
  return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
         base64(read_text(png)) + "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

}  // namespace breast
