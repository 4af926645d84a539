// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <utility>

#include "core/error.hpp"
#include "core/files_written.hpp"
#include "core/own_file.hpp"
#include "core/temporary_folder.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

std::mutex written_mutex;
std::vector<fs::path> written;

// A file name has at most 255 bytes, and the part's must not be longer than the target's may be.
std::string part_prefix(const fs::path& target) {
  constexpr std::size_t longest = 220;
  return "." + target.filename().string().substr(0, longest) + ".part-";
}

fs::path part_of(const fs::path& target) {
  return target.parent_path() / (part_prefix(target) + std::to_string(getpid()));
}

// A descriptor that closes itself; close() tells whether that went well, since a disk's last word
// may come only then.
class Descriptor {
 public:
  Descriptor(const fs::path& file, int flags)
      : id_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return id_ >= 0; }
  int id() const { return id_; }
  bool close() { return ::close(std::exchange(id_, -1)) == 0; }

 private:
  int id_;
};

// A file to be renamed, which is removed on every other way out, also when memory runs out.
class Part {
 public:
  explicit Part(const fs::path& name)
      : name_(name), file_(name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW), left_(bool(file_)) {}
  ~Part() {
    if (left_) ::unlink(name_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  Descriptor& file() { return file_; }
  bool rename(const fs::path& target) {
    left_ = std::rename(name_.c_str(), target.c_str()) != 0;
    return !left_;
  }

 private:
  const fs::path& name_;
  Descriptor file_;
  bool left_;
};

// All of `bytes`, in as many writes as it takes; returns how many went through, with errno set when
// that is fewer.
std::size_t write_all(int descriptor, std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t now = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (now < 0 && errno == EINTR) continue;
    if (now == 0) errno = ENOSPC;
    if (now <= 0) break;
    done += std::size_t(now);
  }
  return done;
}

Error cannot_write(const fs::path& target, std::size_t done, std::size_t all) {
  return failed_error(target.string(), ": cannot be written: ", done, " of ", all, " bytes, then ",
                      std::strerror(errno));
}

void write_through(const fs::path& target, std::string_view bytes) {
  // Appending: what this process printed to the same place stays.
  Descriptor stream(target, O_WRONLY | O_APPEND | O_NOCTTY);
  const std::size_t done = stream ? write_all(stream.id(), bytes) : 0;
  if (!stream || done < bytes.size() || !stream.close()) {
    throw cannot_write(target, done, bytes.size());
  }
}

// Reads the file back: a file system may take every byte and keep fewer, or others (errno is then EIO).
bool holds(int descriptor, std::string_view bytes) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return false;
  bool same = std::size_t(status.st_size) == bytes.size();
  std::string piece(std::min(bytes.size(), std::size_t(1) << 20), '\0');
  for (std::size_t at = 0; same && at < bytes.size();) {
    const ssize_t now = ::pread(descriptor, piece.data(), piece.size(), off_t(at));
    if (now < 0 && errno == EINTR) continue;
    if (now < 0) return false;
    same = now > 0 && bytes.substr(at, std::size_t(now)) ==
                          std::string_view(piece).substr(0, std::size_t(now));
    at += std::size_t(now);
  }
  if (!same) errno = EIO;
  return same;
}

// So that the rename itself survives a power failure; a file system that cannot do it is no reason
// to fail.
void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Descriptor opened(folder, O_RDONLY | O_DIRECTORY);
  if (opened) fsync(opened.id());
}

}  // namespace

bool is_stream(const fs::path& target) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return true;
  fs::path step = target;  // /dev/stdout -> /proc/self/fd/1 -> the file the shell opened
  for (int links = 0; links < 8 && !step.empty(); ++links) {
    const fs::path folder = step.has_parent_path() ? step.parent_path() : fs::path(".");
    if (fs::weakly_canonical(folder, ignored).string().starts_with("/proc/")) return true;
    if (!fs::is_symlink(fs::symlink_status(step, ignored))) return false;
    step = folder / fs::read_symlink(step, ignored);
  }
  return false;
}

void write_bytes(const fs::path& target, std::string_view bytes) {
  if (is_stream(target)) return write_through(target, bytes);
  remove_stale_parts(target);
  const fs::path name = part_of(target);
  std::error_code ignored;
  fs::remove(name, ignored);
  Part part(name);
  Descriptor& file = part.file();
  const std::size_t done = file ? write_all(file.id(), bytes) : 0;
  const bool whole = file && done == bytes.size() && fsync(file.id()) == 0 &&
                     holds(file.id(), bytes) && file.close();
  if (!whole || !part.rename(target)) throw cannot_write(target, done, bytes.size());
  flush_folder(target);
  const std::lock_guard lock(written_mutex);
  written.push_back(target);
}

std::vector<fs::path> files_written() {
  const std::lock_guard lock(written_mutex);
  return written;
}

AtomicFolder::AtomicFolder(const fs::path& target, std::string last)
    : target_(target.has_filename() ? target : target.parent_path()), last_(std::move(last)) {
  check_replaceable(target_ / last_, target_.string());
  remove_stale_parts(target_);
  temporary_ = part_of(target_);
  std::error_code reason;
  fs::create_directories(temporary_, reason);
  if (reason) {
    throw input_error(target_.string(), ": this folder cannot be created (", reason.message(),
                      "); choose another place");
  }
  note_leftover(temporary_.c_str());
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  forget_leftover(temporary_.c_str());
}

void AtomicFolder::commit() {
  try {
    for (const auto& entry : fs::directory_iterator(temporary_)) {
      check_replaceable(target_ / entry.path().filename(), target_.string());
    }
    fs::create_directories(target_);
    fs::remove(target_ / last_);
    for (const auto& entry : fs::directory_iterator(temporary_)) {
      const fs::path name = entry.path().filename();
      if (name != last_) fs::rename(entry.path(), target_ / name);
    }
    fs::rename(temporary_ / last_, target_ / last_);
  } catch (const fs::filesystem_error& error) {
    throw failed_error(target_.string(), ": cannot be replaced (", error.code().message(), ")");
  }
}

void AtomicFolder::replace() {
  try {
    replace_folder(temporary_, target_);
  } catch (const fs::filesystem_error& error) {
    throw failed_error(target_.string(), ": cannot be replaced (", error.code().message(), ")");
  }
}

void replace_folder(const fs::path& finished, const fs::path& target) {
  if (!fs::exists(target)) {
    fs::rename(finished, target);
    return;
  }
  const fs::path old = finished.string() + "-old";
  fs::rename(target, old);
  fs::rename(finished, target);
  fs::remove_all(old);
}

void remove_stale_parts(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string prefix = part_prefix(target);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    std::string owner_text = name.substr(prefix.size());
    if (owner_text.ends_with("-old")) owner_text.resize(owner_text.size() - 4);  // replace_folder
    const bool number = !owner_text.empty() && owner_text.size() < 10 &&
                        owner_text.find_first_not_of("0123456789") == std::string::npos;
    if (!number) continue;  // somebody else's, such as .scan.nrrd.part-notes
    const pid_t owner = static_cast<pid_t>(std::stol(owner_text));
    if (owner > 0 && owner != getpid() && (kill(owner, 0) == 0 || errno == EPERM)) continue;
    std::error_code reason;
    fs::remove_all(entry.path(), reason);  // a DICOM folder's part is a folder
  }
}

std::string read_text(const fs::path& source, std::uintmax_t most_bytes) {
  std::error_code reason;
  const fs::file_status status = fs::status(source, reason);
  if (fs::is_directory(status)) throw input_error(source.string(), ": is a folder, not a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw input_error(source.string(), ": is a device or pipe; copy its content to a file first");
  }
  std::ifstream in(source, std::ios::binary);
  if (!in) throw input_error(source.string(), ": cannot be opened");
  const std::uintmax_t size = fs::file_size(source, reason);
  if (reason) throw input_error(source.string(), ": cannot be read (", reason.message(), ")");
  if (size > most_bytes) {
    throw input_error(source.string(), ": ", size, " bytes, at most ", most_bytes, " are read");
  }
  std::string text(std::size_t(size), '\0');
  in.read(text.data(), std::streamsize(size));
  if (in.bad()) throw input_error(source.string(), ": cannot be read");
  text.resize(std::size_t(in.gcount()));
  return text;
}

}  // namespace breast
