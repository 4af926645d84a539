// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/scan_identity.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/provenance.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

bool is_phantom(const std::string& scan) {
  return scan.starts_with("phantom:");
}

std::string hash_of_text(const std::string& text) {
  Sha256 hash;
  hash.update(text);
  return hash.hex();
}

std::string hash_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  Sha256 hash;
  std::vector<char> piece(std::size_t(1) << 20);
  while (in.read(piece.data(), std::streamsize(piece.size())) || in.gcount() > 0)
    hash.update(piece.data(), std::size_t(in.gcount()));
  if (!in.eof())
    throw input_error(
        file.string(),
        ": this file of the scan could not be read to its end; check the file and the disk");
  return hash.hex();
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::follow_directory_symlink))
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder));
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  return files;
}

std::string state_of(const fs::path& file) {
  struct stat state {};
  if (stat(file.c_str(), &state) != 0)
    throw input_error(file.string(), ": this file of the scan cannot be read (",
                      std::strerror(errno), "); check its name and permissions");
  return message(state.st_dev, " ", state.st_ino, " ", state.st_size, " ", state.st_mtim.tv_sec,
                 ".", state.st_mtim.tv_nsec, " ", state.st_ctim.tv_sec, ".", state.st_ctim.tv_nsec,
                 "\n");
}

/// Refuses a device or a pipe, which might never end.
void check_kind(const std::string& scan) {
  if (is_phantom(scan) || !fs::exists(scan)) return;
  if (!fs::is_directory(scan) && !fs::is_regular_file(scan))
    throw input_error(scan, ": neither a file nor a folder: give the scan's own file");
}

std::string stamp_of(const std::string& scan) {
  if (is_phantom(scan)) return scan;
  if (!fs::is_directory(scan)) return hash_of_text(state_of(scan));
  std::string all;
  for (const fs::path& file : files_below(scan)) all += file.string() + " " + state_of(scan / file);
  return hash_of_text(all);
}

// Hashes are listed in the format of `sha256sum`, so that records of older versions remain valid.
std::string content_of(const std::string& scan) {
  if (is_phantom(scan)) return scan;
  if (!fs::is_directory(scan)) return hash_of_text(hash_of_file(scan) + "  -\n");
  std::string all;
  for (const fs::path& file : files_below(scan))
    all += hash_of_file(scan / file) + "  ./" + file.string() + "\n";
  return hash_of_text(all);
}

std::string remembered(const std::string& record, const std::string& key) {
  std::istringstream in(record);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + "\t")) return line.substr(key.size() + 1);
  return "";
}

}  // namespace

std::string mixed_up(const fs::path& run, const std::string& side, const std::string& scan) {
  check_kind(scan);
  const fs::path file = run / ".scan";
  if ((!is_phantom(scan) && !fs::exists(scan)) || !fs::exists(file)) return "";
  const std::string record = read_text(file), held = remembered(record, "side");
  if (held != side)
    return message(run.string(), " holds the ", held,
                   " breast of its scan, and the run asked for is of the ", side,
                   " one; give it another folder with CASE=NAME, or remove the folder");
  if (remembered(record, "stamp") == stamp_of(scan) ||
      remembered(record, "content") == content_of(scan))
    return "";
  return message(run.string(),
                 " holds the run of another scan; give this one another folder with CASE=NAME, or "
                 "remove the folder if the scan itself was replaced");
}

void remember_scan(const fs::path& run, const std::string& side, const std::string& scan) {
  check_kind(scan);
  fs::create_directories(run);
  const fs::path file = run / ".scan", own = run / message(".scan-of-", getpid());
  const std::string record =
      "side\t" + side + "\ncontent\t" + content_of(scan) + "\nstamp\t" + stamp_of(scan) + "\n";
  // Of two runs that begin at once, one has the folder: a link is made by the first alone.
  write_text(own, record);
  const bool first = link(own.c_str(), file.c_str()) == 0;
  fs::remove(own);
  if (first) return;
  const std::string reason = mixed_up(run, side, scan);
  if (!reason.empty()) throw input_error(reason);
  write_text(file, record);
}

}  // namespace breast
