// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/installation.hpp"

#include <unistd.h>

#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

bool Installation::is_package() const {
  return fs::exists(pipeline.parent_path() / "pipelines/installed.mk");
}

fs::path Installation::documentation() const {
  const fs::path folder = pipeline.parent_path();
  return is_package() ? folder.parent_path() / "doc/libbreast" : folder / "docs";
}

bool Installation::has(const std::string& name) const {
  return std::any_of(tools.begin(), tools.end(),
                     [&](const ToolEntry& t) { return t.name == name; });
}

std::vector<std::string> Installation::tool_names() const {
  std::vector<std::string> names;
  for (const ToolEntry& entry : tools) names.push_back(entry.name);
  return names;
}

Installation find_installation(const fs::path& program, const std::vector<ToolEntry>& built) {
  const fs::path folder = program.parent_path(), prefix = folder.parent_path();
  Installation found;
  if (fs::is_directory(prefix / "libexec/breast")) {
    found.programs = prefix / "libexec/breast";
    found.pipeline = prefix / "share/breast/Makefile.pipeline";
  } else {
    found.programs = folder;
    found.pipeline = prefix.parent_path().parent_path() / "Makefile.pipeline";
  }
  for (const ToolEntry& entry : built) {
    if (access(found.tool(entry.name).c_str(), X_OK) == 0) found.tools.push_back(entry);
  }
  if (found.tools.empty())
    throw failed_error("no tools in ", found.programs.string(), ": the installation of ",
                       program.string(), " is incomplete");
  std::sort(found.tools.begin(), found.tools.end(),
            [](const ToolEntry& a, const ToolEntry& b) { return a.name < b.name; });
  return found;
}

}  // namespace breast
