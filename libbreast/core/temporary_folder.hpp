// SPDX-License-Identifier: GPL-3.0-or-later
// A temporary folder that is removed after use, even if the program ends without stack unwinding.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

class TemporaryFolder {
 public:
  /// Creates an empty folder in the system's folder for temporary files; throws Error (failed) if
  /// that is not possible.
  TemporaryFolder();
  /// Removes the folder with all its contents.
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Registers the folder for remove_leftovers(). Only a few can be registered at a time; beyond
/// that, or for a very long path, it does nothing.
void note_leftover(const char* folder) noexcept;
void forget_leftover(const char* folder) noexcept;

/// Removes the registered folders of this process (not those of the process from which it was
/// forked) with all their contents. It neither allocates nor locks, so that a signal handler can
/// call it.
void remove_leftovers() noexcept;

}  // namespace breast
