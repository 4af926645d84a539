// SPDX-License-Identifier: GPL-3.0-or-later
// What the stages of a run warned of, each warning once, and what to do about it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// The stages of the chain, in order, as their reports are called.
inline const std::vector<std::string> chain_stages{
    "labels", "geometry",     "mesh",          "reference", "supine", "cc",
    "mlo",    "cc-mammogram", "mlo-mammogram", "curve",     "lookup"};

struct Advice {
  std::string pattern;  ///< an extended regular expression that a warning matches
  std::string remedy;
};
/// Lines PATTERN<tab>REMEDY, '#' begins a comment. Throws Error (input) naming line and text for a pattern that is none.
std::vector<Advice> read_advice(const std::filesystem::path& file);

struct Warning {
  std::string stages;  ///< that say it: "cc, mlo"
  std::string text;
  std::string
      remedy;  ///< of the first pattern that matches; "" where there is none or a later warning has the same
};
struct StageWarnings {
  std::string stage;
  std::vector<std::string> texts;
};
/// In the order of the chain, those with the same advice together; the advice stands in the last of them only.
std::vector<Warning> gather(const std::vector<StageWarnings>& said,
                            const std::vector<Advice>& advice);
/// Of the reports of a run.
std::vector<Warning> warnings_of(const std::filesystem::path& run,
                                 const std::vector<Advice>& advice);

}  // namespace breast
