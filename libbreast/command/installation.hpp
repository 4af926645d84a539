// SPDX-License-Identifier: GPL-3.0-or-later
// The installation to which a running `breast` belongs: its tools and its pipeline.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

struct ToolEntry {
  std::string name, summary;
};

struct Installation {
  std::filesystem::path programs;  ///< folder of the tools
  std::filesystem::path pipeline;  ///< Makefile.pipeline
  std::vector<ToolEntry> tools;    ///< those of the build that are there, by name

  std::filesystem::path tool(const std::string& name) const { return programs / name; }
  /// Whether this is an installed package, which lacks what needs the source tree.
  bool is_package() const;
  /// Folder of the documentation.
  std::filesystem::path documentation() const;
  bool has(const std::string& name) const;
  std::vector<std::string> tool_names() const;
};

/// The installation of a program PREFIX/bin/breast is PREFIX/libexec/breast and
/// PREFIX/share/breast; in a build tree it is the program's own folder and the source tree three
/// folders up. `built` are all tools of the build. Throws Error (failed) if neither is found.
Installation find_installation(const std::filesystem::path& program,
                               const std::vector<ToolEntry>& built);

}  // namespace breast
