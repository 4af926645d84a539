// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of tables and pages that tabulate makes, each with its arguments and function.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// The arguments of one call.
struct TabulateRequest {
  std::vector<std::string> words;  ///< arguments of the kind
  std::filesystem::path
      pipelines;  ///< folder of the pipeline's tables: advice.tsv, limits.txt, paper/, invivo/
  std::filesystem::path
      calibrated;    ///< report of a phantom with a preset fitted to the chain; empty for none
  std::string side;  ///< side of that phantom

  const std::string& word(std::size_t i) const { return words[i]; }
  std::vector<std::string> rest(std::size_t first) const {
    return {words.begin() + long(first), words.end()};
  }
  Table table(std::size_t i) const { return read_table(words[i]); }
  std::filesystem::path own(const std::string& file) const { return pipelines / file; }
};

struct TabulateKind {
  std::string name, arguments, help;
  /// Smallest and largest number of arguments.
  std::size_t least, most;
  std::function<std::string(const TabulateRequest&)> make;  ///< returns the text for stdout
};

std::vector<TabulateKind> table_kinds();  ///< tables of the paper and of studies
std::vector<TabulateKind> page_kinds();   ///< texts and pages of cases, reports and documents
std::vector<TabulateKind> cohort_kinds();

inline constexpr std::size_t any_number = std::size_t(-1);

}  // namespace breast
