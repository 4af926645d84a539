// SPDX-License-Identifier: GPL-3.0-or-later
// A temporary folder that is removed after use, even if the program ends without stack unwinding.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

class TemporaryFolder {
 public:
  /// An empty folder where the system keeps such; throws Error (failed) where it cannot be made.
  TemporaryFolder();
  /// Removes it with all that is in it.
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// From now on remove_leftovers() removes this folder. A few at a time; beyond that, or where the path is very long, it
/// does nothing.
void note_leftover(const char* folder) noexcept;
void forget_leftover(const char* folder) noexcept;

/// Removes the noted folders of this process (not those of the process it was forked from) with all that is in them.
/// Neither allocates nor locks: it may be called in a signal handler.
void remove_leftovers() noexcept;

}  // namespace breast
