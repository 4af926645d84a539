// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that the input files of a tool belong together, by their histories.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/provenance.hpp"
#include "core/types.hpp"

namespace breast {

/// Throws Error (input) naming `file` if `history` states inputs of `tool` and none of them has this
/// SHA-256, that of the file's content: the tool was given another file.
void check_given_to(const std::string& tool, const History& history,
                    const std::filesystem::path& file, const std::string& sha256);

/// A file, the SHA-256 of its content, what led to it, and the side of its breast.
struct Origin {
  std::filesystem::path file;
  std::string sha256;
  const History* history = nullptr;
  std::optional<Side> side = {};
};

/// Origin of a mesh, labels or a mammogram read from `file`.
template <class Content>
Origin origin_of(const std::filesystem::path& file, const Content& content) {
  return {file, content.content_sha256, &content.history, content.side};
}

/// Throws Error (input) naming both files if they are of different sides, or if both state inputs, have
/// none in common, and neither file is an input of the other: they come from different breasts.
void check_same_origin(const Origin& a, const Origin& b);

}  // namespace breast
