// SPDX-License-Identifier: GPL-3.0-or-later
// What tabulate can make: each kind with its arguments, and the function that makes it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// What a kind is asked for.
struct TabulateRequest {
  std::vector<std::string> words;  ///< its arguments
  std::filesystem::path
      pipelines;  ///< the pipeline's own tables: advice.tsv, limits.txt, paper/, invivo/
  std::filesystem::path
      calibrated;    ///< report of a phantom whose preset was fitted to the chain; empty: none
  std::string side;  ///< of that phantom

  const std::string& word(std::size_t i) const { return words[i]; }
  std::vector<std::string> rest(std::size_t first) const {
    return {words.begin() + long(first), words.end()};
  }
  Table table(std::size_t i) const { return read_table(words[i]); }
  std::filesystem::path own(const std::string& file) const { return pipelines / file; }
};

struct TabulateKind {
  std::string name, arguments, help;
  std::size_t least, most;                                  ///< how many arguments
  std::function<std::string(const TabulateRequest&)> make;  ///< the text for stdout
};

std::vector<TabulateKind> table_kinds();  ///< of the paper's tables and of studies
std::vector<TabulateKind> page_kinds();   ///< of a case, of reports and of documents
std::vector<TabulateKind> cohort_kinds();

inline constexpr std::size_t any_number = std::size_t(-1);

}  // namespace breast
