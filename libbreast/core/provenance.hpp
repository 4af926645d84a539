// SPDX-License-Identifier: GPL-3.0-or-later
// Provenance of a file: all commands that led to it, with the SHA-256 of the content of their
// inputs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace breast {

/// Streaming SHA-256 (FIPS 180-4).
class Sha256 {
 public:
  Sha256();
  void update(const void* data, std::size_t size);
  void update(std::string_view text) { update(text.data(), text.size()); }
  /// 64 lower-case hex digits; the object must not be used afterwards.
  std::string hex();

 private:
  void block(const unsigned char* data);
  unsigned state_[8];
  unsigned char buffer_[64];
  std::size_t used_ = 0;
  unsigned long long total_ = 0;
};

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
