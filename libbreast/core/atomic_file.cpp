#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {
std::string part_prefix(const fs::path& target) {
  return "." + target.filename().string() + ".part-";
}
}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  remove_stale_parts(target_);
  temporary_ = target_.parent_path() / (part_prefix(target_) + std::to_string(getpid()));
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  const int descriptor = open(temporary_.c_str(), O_RDONLY);
  if (descriptor < 0 || fsync(descriptor) != 0) {
    const int reason = errno;
    if (descriptor >= 0) close(descriptor);
    throw failed_error(target_.string(), ": cannot be written (", std::strerror(reason), ")");
  }
  close(descriptor);
  std::error_code reason;
  fs::rename(temporary_, target_, reason);
  if (reason) throw failed_error(target_.string(), ": cannot be replaced (", reason.message(), ")");
  committed_ = true;
}

AtomicFolder::AtomicFolder(const fs::path& target, std::string last)
    : target_(target.has_filename() ? target : target.parent_path()), last_(std::move(last)) {
  remove_stale_parts(target_);
  temporary_ = target_.parent_path() / (part_prefix(target_) + std::to_string(getpid()));
  std::error_code reason;
  fs::create_directories(temporary_, reason);
  if (reason) {
    throw input_error(target_.string(), ": this folder cannot be made (", reason.message(),
                      "); choose another place");
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  try {
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

void remove_stale_parts(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string prefix = part_prefix(target);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    const pid_t owner = static_cast<pid_t>(std::atol(name.c_str() + prefix.size()));
    if (owner > 0 && owner != getpid() && kill(owner, 0) == 0) continue;
    std::error_code reason;
    fs::remove_all(entry.path(), reason);  // a DICOM folder's part is a folder
  }
}

void write_text(const fs::path& target, const std::string& text) {
  AtomicFile file(target);
  {
    std::ofstream out(file.temporary(), std::ios::binary);
    out << text;
    out.flush();
    if (!out) throw failed_error(target.string(), ": cannot be written");
  }
  file.commit();
}

std::string read_text(const fs::path& source) {
  std::ifstream in(source, std::ios::binary);
  if (!in) throw input_error(source.string(), ": cannot be opened");
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw input_error(source.string(), ": cannot be read");
  return text.str();
}

}  // namespace breast
