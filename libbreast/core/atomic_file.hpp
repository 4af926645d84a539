// Results appear by write-then-rename: nobody ever sees half a file.
#pragma once

#include <filesystem>

namespace breast {

/// Write to temporary() (hidden, `.NAME.part-PID`, same folder, same extension kept as suffix in
/// the name), then commit(). Without commit the temporary is removed.
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

/// A folder of results: files are written into temporary() (hidden, beside the target), commit()
/// moves them into the target with `last` as the last one, after the target's old `last` is gone.
/// Readers that ask for `last` never see half a result. Without commit the temporary is removed.
class AtomicFolder {
 public:
  /// Makes temporary(); throws Error (input) where that is not possible.
  AtomicFolder(const std::filesystem::path& target, std::string last);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Throws Error (failed) naming the target.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  std::string last_;
};

/// Removes `.NAME.part-PID` files of processes that no longer run.
void remove_stale_parts(const std::filesystem::path& target);
/// Writes text atomically.
void write_text(const std::filesystem::path& target, const std::string& text);
/// Whole file as text; throws Error (input) naming the file.
std::string read_text(const std::filesystem::path& source);

}  // namespace breast
