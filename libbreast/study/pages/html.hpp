// SPDX-License-Identifier: GPL-3.0-or-later
// Text, tables and pictures of pages that can be sent: every byte of input is escaped, nothing is fetched, no script runs.
#pragma once

#include <filesystem>
#include <string>

#include "core/table.hpp"

namespace breast {

/// With & < > " ' as entities, and bytes that are no UTF-8 as U+FFFD.
std::string escaped(const std::string& text);
std::string base64(const std::string& bytes);

/// A page up to its first heading. `title` is escaped here.
std::string page_head(const std::string& title, const std::string& style);
inline const std::string page_end = "</body></html>\n";

/// Tab-separated text as a table; numbers stand to the right; cells "fails", "differs", "missing" and "failed" stand out; comments
/// are left out. "" of a text without a row.
std::string html_table(const std::string& tsv);
/// Of a file; "" where it is absent.
std::string html_table_of(const std::filesystem::path& file);
/// The picture inline, with its caption; "" where the file is absent.
std::string html_figure(const std::filesystem::path& png, const std::string& caption);

}  // namespace breast
