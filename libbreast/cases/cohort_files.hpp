// SPDX-License-Identifier: GPL-3.0-or-later
// The case files of a cohort's folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

struct CohortEntry {
  std::string name;      ///< of the case, and of its folder below the runs of the cohort
  std::string file;      ///< path of its case file
  bool phantom = false;  ///< true if the case file names no MR scan
};

/// The cases of a cohort, sorted by the paths of their files: COHORT/*.case and COHORT/*/case.txt.
/// `known` lists the keys of case files.
/// Throws Error (input) if there is no case, if a path below COHORT contains a character that is
/// refused, if two cases have the same name, or if any case file is refused or names neither MR nor
/// PRESET: a phantom would otherwise be run under the name of the patient whose MR was left out.
std::vector<CohortEntry> cohort_entries(const std::filesystem::path& cohort,
                                        const std::vector<std::string>& known);

}  // namespace breast
