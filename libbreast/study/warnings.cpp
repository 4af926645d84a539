// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/warnings.hpp"

#include <algorithm>
#include <optional>
#include <regex>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/one_line.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace {

std::regex pattern_of(const std::string& text, const std::string& where) {
  try {
    return std::regex(text, std::regex::extended);
  } catch (const std::regex_error&) {
    throw input_error(where, ": '", text, "' is not an extended regular expression");
  }
}

}  // namespace

std::vector<Advice> read_advice(const std::filesystem::path& file) {
  std::vector<Advice> list;
  std::istringstream in(read_text(file));
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::size_t tab = line.find('\t');
    if (line.empty() || line.front() == '#' || tab == std::string::npos) continue;
    list.push_back({line.substr(0, tab), line.substr(tab + 1)});
    pattern_of(list.back().pattern, message(file.string(), ", line ", number));
  }
  return list;
}

std::vector<Warning> gather(const std::vector<StageWarnings>& said,
                            const std::vector<Advice>& advice) {
  std::vector<Warning> all;
  for (const StageWarnings& stage : said) {
    for (const std::string& raw : stage.texts) {
      const std::string text = one_line(raw);
      const auto known =
          std::find_if(all.begin(), all.end(), [&](const Warning& w) { return w.text == text; });
      if (known == all.end())
        all.push_back({stage.stage, text, ""});
      else
        known->stages += ", " + stage.stage;
    }
  }
  std::vector<std::regex> patterns;
  for (const Advice& a : advice) patterns.push_back(pattern_of(a.pattern, "advice"));
  // The advice for a warning; a warning without advice is a group of its own.
  std::vector<std::size_t> group(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    group[k] = advice.size() + k;
    for (std::size_t p = patterns.size(); p-- > 0;)
      if (std::regex_search(all[k].text, patterns[p])) group[k] = p;
  }
  std::vector<Warning> ordered;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (std::find(group.begin(), group.begin() + long(k), group[k]) != group.begin() + long(k))
      continue;
    for (std::size_t j = k; j < all.size(); ++j)
      if (group[j] == group[k]) ordered.push_back(all[j]);
    if (group[k] < advice.size()) ordered.back().remedy = advice[group[k]].remedy;
  }
  return ordered;
}

std::vector<Warning> warnings_of(const std::filesystem::path& run,
                                 const std::vector<Advice>& advice) {
  std::vector<StageWarnings> said;
  for (const std::string& stage : chain_stages)
    said.push_back({stage, StageReport::read(run / (stage + ".json")).texts("warnings")});
  return gather(said, advice);
}

}  // namespace breast
