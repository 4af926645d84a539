// SPDX-License-Identifier: GPL-3.0-or-later
// The warnings of a run's stages, each listed once, with advice on what to do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// The names of the reports of the chain's stages, in order.
inline const std::vector<std::string> chain_stages{
    "labels", "geometry",     "mesh",          "reference", "supine", "cc",
    "mlo",    "cc-mammogram", "mlo-mammogram", "curve",     "lookup"};

struct Advice {
  std::string pattern;  ///< an extended regular expression that a warning matches
  std::string remedy;
};
/// Reads lines PATTERN<tab>REMEDY; '#' begins a comment. Throws Error (input) naming line and text
/// if a pattern is invalid.
std::vector<Advice> read_advice(const std::filesystem::path& file);

struct Warning {
  std::string stages;  ///< the stages that give it, such as "cc, mlo"
  std::string text;
  std::string
      remedy;  ///< of the first pattern that matches; "" where there is none or a later warning has the same
};
struct StageWarnings {
  std::string stage;
  std::vector<std::string> texts;
};
/// Merges warnings in the order of the chain; those with the same advice are adjacent, and only the
/// last of them contains the advice.
std::vector<Warning> gather(const std::vector<StageWarnings>& said,
                            const std::vector<Advice>& advice);
/// The merged warnings from the reports of a run.
std::vector<Warning> warnings_of(const std::filesystem::path& run,
                                 const std::vector<Advice>& advice);

}  // namespace breast
