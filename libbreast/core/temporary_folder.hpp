// A folder of one's own for as long as it is needed.
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

}  // namespace breast
