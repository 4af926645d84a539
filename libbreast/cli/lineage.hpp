// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that the input files of a tool belong together, by their histories.
#pragma once

#include <filesystem>
#include <string>

#include "core/provenance.hpp"

namespace breast {

/// Throws Error (input) naming `file` if `history` states inputs of `tool` and none of them has this
/// SHA-256, that of the file's content: the tool was given another file.
void check_given_to(const std::string& tool, const History& history,
                    const std::filesystem::path& file, const std::string& sha256);

/// A file, the SHA-256 of its content, and what led to it.
struct Origin {
  std::filesystem::path file;
  std::string sha256;
  const History* history = nullptr;
};

/// Throws Error (input) naming both files if both state inputs, have none in common, and neither file is an
/// input of the other: they come from different scans.
void check_same_origin(const Origin& a, const Origin& b);

}  // namespace breast
