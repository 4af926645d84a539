// SPDX-License-Identifier: GPL-3.0-or-later
// The case files of a cohort's folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

struct CohortEntry {
  std::string name;  ///< of the case and of its folder below the cohort's runs
  std::string file;  ///< its case file
  bool phantom = false;
};

/// COHORT/*.case and COHORT/*/case.txt (and, as version 0.1 called them, *.mk and */case.mk), in the order of their paths. Throws
/// Error (input) where there is none, where a name below COHORT holds what make or a shell would read as code, where two cases have
/// one name, and for every case file that is refused or names neither MR nor PRESET: a slip in MR would run the phantom as that
/// patient.
std::vector<CohortEntry> cohort_entries(const std::filesystem::path& cohort,
                                        const std::vector<std::string>& known);

}  // namespace breast
