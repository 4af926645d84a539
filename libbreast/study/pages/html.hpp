// SPDX-License-Identifier: GPL-3.0-or-later
// HTML text, tables and pictures for self-contained pages: all input is escaped, nothing is
// fetched, and no script runs.
#pragma once

#include <filesystem>
#include <string>

#include "core/table.hpp"

namespace breast {

/// The text with & < > " ' as entities and bytes that are not valid UTF-8 as U+FFFD.
std::string escaped(const std::string& text);

/// The beginning of a page, up to its first heading. `title` is escaped by this function.
std::string page_head(const std::string& title, const std::string& style);
inline const std::string page_end = "</body></html>\n";

/// Tab-separated text as an HTML table. Numbers are right-aligned; cells "fails", "differs",
/// "missing" and "failed" are highlighted; comments are omitted. "" if the text has no row.
std::string html_table(const std::string& tsv);
/// The HTML table of a file; "" if the file is absent.
std::string html_table_of(const std::filesystem::path& file);
/// The picture inline, with its caption; "" if the file is absent.
std::string html_figure(const std::filesystem::path& png, const std::string& caption);

}  // namespace breast
