// SPDX-License-Identifier: GPL-3.0-or-later
// Case files: the settings of a patient, KEY = VALUE a line, as data. Nothing in them is executed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace breast {

struct CaseFile {
  std::vector<std::pair<std::string, std::string>> settings;  ///< in the order of the file
  std::string warning;  ///< of a makefile of version 0.1, whose := and ?= are read as =; else ""

  bool has(const std::string& key) const;
};

/// `known`: the keys that a case may have. Throws Error (input) naming file and line for anything but KEY = VALUE, an unknown key,
/// a key that stands there twice, and a value that holds what make or a shell would read as code. '#' begins a comment. Files named
/// *.mk are makefiles of version 0.1.
CaseFile read_case_file(const std::filesystem::path& file, const std::vector<std::string>& known);
/// The same from the bytes of the file `name`.
CaseFile parse_case_file(const std::string& text, const std::string& name,
                         const std::vector<std::string>& known);

}  // namespace breast
