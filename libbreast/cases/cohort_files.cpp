// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/cohort_files.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "cases/case_file.hpp"
#include "command/make_name.hpp"
#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

bool ends_case(const fs::path& file) {
  return file.extension() == ".case";
}
bool is_inner_case(const fs::path& file) {
  return file.filename() == "case.txt";
}

// Hidden files and folders do not belong to a cohort.
std::vector<fs::path> visible(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (!entry.path().filename().native().starts_with('.')) found.push_back(entry.path());
  return found;
}

std::vector<fs::path> case_files(const fs::path& cohort) {
  std::vector<fs::path> files;
  for (const fs::path& entry : visible(cohort)) {
    if (ends_case(entry)) files.push_back(entry);
    if (!fs::is_directory(entry)) continue;
    for (const fs::path& inner : visible(entry))
      if (is_inner_case(inner)) files.push_back(inner);
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  return files;
}

void check_name(const fs::path& file, const fs::path& cohort) {
  const std::string below = file.lexically_relative(cohort);
  if (plain_for_make("./" + below)) return;
  std::string shown = below;
  std::replace_if(
      shown.begin(), shown.end(),
      [](unsigned char c) {
        return !(std::isalnum(c) || c == '.' || c == '/' || c == '_' || c == '-');
      },
      '?');
  throw input_error("COHORT: ", shown,
                    ": a name with such characters is refused; use letters, digits, points, dashes "
                    "and underscores (each ? is such a character)");
}

std::string case_name(const fs::path& file) {
  return is_inner_case(file) ? file.parent_path().filename() : file.stem();
}

}  // namespace

std::vector<CohortEntry> cohort_entries(const fs::path& cohort,
                                        const std::vector<std::string>& known) {
  const std::vector<fs::path> files = case_files(cohort);
  if (files.empty())
    throw input_error(
        "COHORT=", cohort.string(),
        " holds no case; a case is a file *.case or */case.txt");
  for (const fs::path& file : files) check_name(file, cohort);
  std::map<std::string, fs::path> named;
  for (const fs::path& file : files) {
    const auto [other, is_new] = named.emplace(case_name(file), file);
    if (!is_new)
      throw input_error("COHORT=", cohort.string(), ": two case files are called ", other->first,
                        ": ", other->second.string(), " and ", file.string(),
                        "; rename one of them");
  }
  std::vector<CohortEntry> entries;
  std::string problems;
  const auto problem = [&](const std::string& text) {
    problems += (problems.empty() ? "" : "; ") + text;
  };
  for (const fs::path& file : files) {
    try {
      const CaseFile read = read_case_file(file, known);
      if (!read.has("MR") && !read.has("PRESET"))
        problem("case file " + file.string() +
                ": names neither MR nor PRESET; add MR = SCAN, or PRESET = NAME for a phantom");
      entries.push_back({case_name(file), file.string(), !read.has("MR")});
    } catch (const Error& error) {
      problem(error.what());
    }
  }
  if (!problems.empty()) throw input_error(problems);
  return entries;
}

}  // namespace breast
