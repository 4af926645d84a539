// SPDX-License-Identifier: GPL-3.0-or-later
// Provenance of a file: all commands that led to it, with the SHA-256 of the content of their
// inputs.
#pragma once

#include <string>
#include <vector>

namespace breast {

struct InputRecord {
  std::string name;    ///< file name without folders (no machine's path enters a file)
  std::string sha256;  ///< of the content, without history, run time and solve timings
};

struct HistoryEntry {
  std::string tool;
  std::string version;
  std::string command;  ///< arguments as given, paths reduced to file names
  std::vector<InputRecord> inputs;
};

/// All commands that led to a file, oldest first, each once.
using History = std::vector<HistoryEntry>;

/// The union of histories in the order of first appearance, followed by `entry`.
History extend_history(const std::vector<const History*>& inputs, const HistoryEntry& entry);

}  // namespace breast
