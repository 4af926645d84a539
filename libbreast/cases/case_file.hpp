// SPDX-License-Identifier: GPL-3.0-or-later
// Case files contain the settings of one patient, one KEY = VALUE per line. They are read as data;
// nothing in them is executed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace breast {

struct CaseFile {
  std::vector<std::pair<std::string, std::string>> settings;  ///< in the order of the file

  bool has(const std::string& key) const;
};

/// Reads a case file; `known` lists the keys that it may contain. A '#' at the start of a line or
/// after a blank begins a comment. Throws Error (input) if the file cannot be read or is larger than 64 kB, and,
/// naming the file and the line, for a line that is not KEY = VALUE, for an unknown or repeated
/// key, and for a value with a control character or one that make or a shell would interpret as
/// code.
CaseFile read_case_file(const std::filesystem::path& file, const std::vector<std::string>& known);
/// The same for the content `text` of a file called `name`.
CaseFile parse_case_file(const std::string& text, const std::string& name,
                         const std::vector<std::string>& known);
/// The value of `key` in the text of a case file that read_case_file accepted before; "" if it is
/// not there.
std::string setting_in(const std::string& text, const std::string& key);

}  // namespace breast
