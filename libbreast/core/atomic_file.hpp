// SPDX-License-Identifier: GPL-3.0-or-later
// Atomic output files and folders: results are written under a temporary name and then renamed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace breast {

/// Writes `bytes` beside the target as `.NAME.part-PID`, checks every write, flushes to the disk,
/// reads back and compares, and then renames the file to the target; all files are written in this
/// way. After a failure the target is unchanged and the part is removed. A target that is not a
/// regular file (/dev/null, a pipe) or is a stream of this process (/dev/stdout) is written to
/// directly. Throws Error (failed) naming the target, the bytes written and the system's reason.
void write_bytes(const std::filesystem::path& target, std::string_view bytes);
/// The same, for text.
inline void write_text(const std::filesystem::path& target, std::string_view text) {
  write_bytes(target, text);
}
/// True if write_bytes would write directly to the target: a device, a pipe, or a stream such as
/// /dev/stdout.
bool is_stream(const std::filesystem::path& target);

/// A folder of results. Files are written into temporary() (hidden, beside the target). commit()
/// first removes the target's old `last`, then moves the files into the target, and finally moves
/// `last`: readers that wait for `last` never see an incomplete result. Without a commit the
/// temporary folder is removed.
class AtomicFolder {
 public:
  /// Creates temporary(); throws Error (input) if this is not possible, or if the target contains a
  /// `last` of another program.
  AtomicFolder(const std::filesystem::path& target, std::string last);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Moves the files. Throws Error (failed) naming the target, or Error (input) if the target
  /// contains another program's file of the same name.
  void commit();
  /// Puts the folder in the place of the target as a whole: nothing of an older one stays. The caller
  /// has checked that everything in it may go. Throws Error (failed) naming the target.
  void replace();

 private:
  std::filesystem::path target_, temporary_;
  std::string last_;
};

/// Renames `finished` to `target`, in the place of an older folder of that name, which is removed.
/// Throws std::filesystem::filesystem_error.
void replace_folder(const std::filesystem::path& finished, const std::filesystem::path& target);
/// Removes `.NAME.part-PID` files of processes that no longer run; PID is digits and nothing else.
void remove_stale_parts(const std::filesystem::path& target);
/// The whole file as text. Throws Error (input) naming the file, also if it is not a regular file
/// (a device or pipe may never end) or is larger than `most_bytes`.
std::string read_text(const std::filesystem::path& source,
                      std::uintmax_t most_bytes = std::uintmax_t(1) << 32);

}  // namespace breast
