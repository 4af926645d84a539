// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/case_file.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "cases/make_text.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/trimmed.hpp"

namespace breast {

namespace {

constexpr std::size_t most_bytes = 65536;

struct Line {
  std::string key, value;
};

// A comment in a value begins at a '#' that follows a blank.
std::string without_comment(const std::string& value) {
  for (std::size_t at = 0; at + 1 < value.size(); ++at)
    if ((value[at] == ' ' || value[at] == '\t') && value[at + 1] == '#') return value.substr(0, at);
  return value;
}

std::optional<Line> split_line(const std::string& line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos || equals == 0) return {};
  Line split{trimmed(line.substr(0, equals)), line.substr(equals + 1)};
  const bool letters =
      !split.key.empty() && std::all_of(split.key.begin(), split.key.end(), [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
      });
  if (!letters) return {};
  split.value = trimmed(without_comment(trimmed(split.value)));
  return split;
}

void check_value(const Line& line, const std::string& at) {
  if (!code_in(line.value).empty())
    throw input_error(at, ": ", line.key, " contains the character ", code_in(line.value),
                      ", which make or a shell would read as code; give a name without it, or a "
                      "link that has such a name (ln -s)");
  if (has_control(line.value))
    throw input_error(at, ": the value of ", line.key,
                      " contains a control character; write the line again in a text editor");
}

}  // namespace

std::string setting_in(const std::string& text, const std::string& key) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::optional<Line> split = split_line(trimmed(line));
    if (split && split->key == key) return split->value;
  }
  return "";
}

bool CaseFile::has(const std::string& key) const {
  return std::any_of(settings.begin(), settings.end(),
                     [&](const auto& setting) { return setting.first == key; });
}

CaseFile parse_case_file(const std::string& text, const std::string& name,
                         const std::vector<std::string>& known) {
  const std::string what = "case file " + name;
  if (text.size() > most_bytes)
    throw input_error(what, " has ", text.size(), " bytes and may not be larger than 64 kB");
  CaseFile found;
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string at = message(what, ", line ", number);
    const std::string content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const std::optional<Line> split = split_line(content);
    if (!split)
      throw input_error(
          at, ": this line is not KEY = VALUE; a case file is data, and nothing in it is executed");
    if (std::find(known.begin(), known.end(), split->key) == known.end())
      throw input_error(at, ": ", split->key, " is no setting of a case",
                        suggestion(split->key, known));
    if (found.has(split->key))
      throw input_error(at, ": ", split->key,
                        " is given for the second time; remove one of the two lines");
    check_value(*split, at);
    found.settings.emplace_back(split->key, split->value);
  }
  return found;
}

CaseFile read_case_file(const std::filesystem::path& file, const std::vector<std::string>& known) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none))
    throw input_error("case file ", file.string(),
                      " does not exist or is not a file that can be read; check CASE_FILE");
  const auto bytes = std::filesystem::file_size(file, none);
  if (bytes > most_bytes)
    throw input_error("case file ", file.string(), " has ", bytes,
                      " bytes and may not be larger than 64 kB");
  return parse_case_file(read_text(file), file.string(), known);
}

}  // namespace breast
