// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/lineage.hpp"

#include <set>

#include "core/error.hpp"

namespace breast {

void check_given_to(const std::string& tool, const History& history,
                    const std::filesystem::path& file, const std::string& sha256) {
  std::string given;
  for (const HistoryEntry& entry : history) {
    if (entry.tool != tool) continue;
    for (const InputRecord& input : entry.inputs) {
      if (input.sha256 == sha256) return;
      given += (given.empty() ? "" : ", ") + input.name;
    }
  }
  if (given.empty()) return;  // made by another program
  throw input_error(file.string(), ": is not what ", tool, " was given (", given,
                    "): give that file");
}

namespace {

std::set<std::string> contents_behind(const Origin& origin) {
  std::set<std::string> contents;
  for (const HistoryEntry& entry : *origin.history)
    for (const InputRecord& input : entry.inputs) contents.insert(input.sha256);
  if (!contents.empty()) contents.insert(origin.sha256);
  return contents;
}

}  // namespace

void check_same_origin(const Origin& a, const Origin& b) {
  if (a.side && b.side && *a.side != *b.side)
    throw input_error(a.file.string(), " is of the ", side_name(*a.side), " breast and ",
                      b.file.string(), " of the ", side_name(*b.side),
                      ": give files of one breast");
  const std::set<std::string> of_a = contents_behind(a), of_b = contents_behind(b);
  if (of_a.empty() || of_b.empty()) return;
  for (const std::string& content : of_a) {
    if (of_b.contains(content)) return;
  }
  throw input_error(a.file.string(), " and ", b.file.string(),
                    ": come from different scans: give files of one breast");
}

}  // namespace breast
