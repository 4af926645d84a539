// Results appear by write-then-rename: nobody ever sees half a file.
#pragma once

#include <filesystem>

namespace breast {

/// Write to temporary() (hidden, `.NAME.part-PID`, same folder, same extension kept as suffix in the
/// name), then commit(). Without commit the temporary is removed.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// fsync and rename onto the target; throws Error (failed) naming the target.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Removes `.NAME.part-PID` files of processes that no longer run.
void remove_stale_parts(const std::filesystem::path& target);
/// Writes text atomically.
void write_text(const std::filesystem::path& target, const std::string& text);
/// Whole file as text; throws Error (input) naming the file.
std::string read_text(const std::filesystem::path& source);

}  // namespace breast
