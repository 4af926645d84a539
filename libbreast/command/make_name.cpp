// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/make_name.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/text/utf8.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// The characters that are refused in names by cases/settings_table.hpp.
const std::string refused = "$`;&|<>(){}[]*?!\"'\\^#=:%~";

bool plain_byte(char c) {
  return std::uint8_t(c) > ' ' && c != 0x7f && refused.find(c) == std::string::npos;
}

// A name that is the same for the same file and differs from those of other files.
std::string mark_of(const fs::path& file) {
  std::uint64_t hash = 1469598103934665603u;  // FNV-1a
  for (const char c : file.string()) hash = (hash ^ std::uint8_t(c)) * 1099511628211u;
  std::ostringstream out;
  out << std::hex << hash;
  return out.str();
}

void link_to(const fs::path& target, const fs::path& link) {
  fs::create_directories(link.parent_path());
  std::error_code none;
  if (fs::read_symlink(link, none) == target) return;
  fs::remove(link, none);
  fs::create_symlink(target, link);
}

// A folder of links to the files of `folder`, which are numbered if a name is not plain.
void link_files(const fs::path& folder, const fs::path& links) {
  std::set<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    files.insert(entry.path());
  std::set<std::string> kept;
  std::size_t number = 0;
  for (const fs::path& file : files) {
    const std::string own = file.filename().string();
    ++number;
    const std::string name =
        plain_for_make(own) ? own : "file-" + std::to_string(number) + "-" + plain_name(own);
    kept.insert(name);
    link_to(file, links / name);
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(links)) {
    if (kept.count(entry.path().filename().string()) == 0) fs::remove(entry.path());
  }
}

bool holds_strange_names(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) {
                       return !plain_for_make(entry.path().filename().string());
                     });
}

}  // namespace

bool plain_for_make(const std::string& path) {
  if (path.empty() || path.front() == '-') return false;
  for (std::size_t at = 0; at < path.size();) {
    const std::size_t length = first_character(std::string_view(path).substr(at)).bytes;
    if (length == 0 || (length == 1 && !plain_byte(path[at]))) return false;
    at += length;
  }
  return true;
}

std::string plain_name(const std::string& name) {
  std::string plain;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t length = first_character(std::string_view(name).substr(at)).bytes;
    const bool kept =
        length > 1 || (length == 1 && plain_byte(name[at]) && !(at == 0 && name[at] == '-'));
    plain += kept ? name.substr(at, length) : "_";
    at += std::max<std::size_t>(length, 1);
  }
  return plain;
}

std::string name_for_make(const fs::path& given, const fs::path& links) {
  if (!fs::exists(given)) throw input_error("'", given.string(), "' does not exist");
  std::string text = given.string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  const fs::path file = text;
  const bool named = file.filename() != "." && file.filename() != ".." && file != "/";
  const fs::path whole = named ? fs::canonical(fs::absolute(file).parent_path()) / file.filename()
                               : fs::canonical(file);
  const bool farm = fs::is_directory(whole) && holds_strange_names(whole);
  for (const fs::path& name : {file, whole.lexically_proximate(fs::current_path()), whole}) {
    if (!farm && name.filename() == whole.filename() && plain_for_make(name.string()))
      return name.string();
  }
  const std::string own = whole.filename().string(), ending = whole.extension().string();
  if (farm) {
    const fs::path link = links / mark_of(whole) / plain_name(own);
    fs::create_directories(link);
    link_files(whole, link);
    return link.string();
  }
  if (plain_for_make(own)) {
    const fs::path above = links / mark_of(whole.parent_path());
    link_to(whole.parent_path(), above);
    return (above / own).string();
  }
  if (ending == ".nhdr" || ending == ".mhd")
    throw input_error(
        "'", file.string(),
        "': a header whose data are in another file needs a name without blanks and without any "
        "of ",
        refused, "; rename it");
  const fs::path link = links / mark_of(whole) / plain_name(own);
  link_to(whole, link);
  return link.string();
}

}  // namespace breast
