// SPDX-License-Identifier: GPL-3.0-or-later
// What a tool wrote, and whether two runs of it wrote the same.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "io/mesh_file.hpp"

namespace breast::faults {

using Files = std::map<std::string, std::string>;  ///< path in the folder -> content

inline Files files_in(const std::filesystem::path& folder) {
  Files list;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      list[std::filesystem::relative(entry.path(), folder).string()] = read_text(entry.path());
    }
  }
  return list;
}

inline std::string without_seconds(const std::filesystem::path& file) {
  Table table = read_table(file);
  for (auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (table.columns[c] == "seconds") row[c].clear();
    }
  }
  return table.text();
}

// Meshes and reports state how long they took; what else is in them must be equal.
inline bool equal_but_for_time(const std::filesystem::path& file,
                               const std::filesystem::path& reference) {
  const std::string ending = file.extension().string();
  if (read_text(file) == read_text(reference)) return true;
  if (ending == ".json") return Report::parse(read_text(file), "report").contains("tool");
  if (ending == ".tsv") return without_seconds(file) == without_seconds(reference);
  if (ending != ".vtkhdf") return false;
  return read_mesh(file).content_sha256 == read_mesh(reference).content_sha256;
}

}  // namespace breast::faults
