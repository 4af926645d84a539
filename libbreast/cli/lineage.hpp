// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that the input files of a tool belong together, by their histories.
#pragma once

#include <filesystem>
#include <string>

#include "core/provenance.hpp"

namespace breast {

/// Throws Error (input) naming `file`, whose content has this SHA-256, if `history` has inputs of `tool`
/// and none of them is that content: the file was not what the tool was given.
void check_given_to(const std::string& tool, const History& history,
                    const std::filesystem::path& file, const std::string& sha256);

/// A file, the SHA-256 of its content, and what led to it.
struct Origin {
  std::filesystem::path file;
  std::string sha256;
  const History* history = nullptr;
};

/// Throws Error (input) naming both files if each of them states inputs and none is an input of both
/// or the other file itself: they come from different scans.
void check_same_origin(const Origin& a, const Origin& b);

}  // namespace breast
