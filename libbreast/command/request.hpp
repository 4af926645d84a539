// SPDX-License-Identifier: GPL-3.0-or-later
// The request given to `breast run`, `demo` or `cohort`, parsed from its command line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/declaration.hpp"

namespace breast {

struct PipelineRequest {
  std::string command;  ///< run, demo or cohort
  std::string scan;     ///< of run: a file or folder; of cohort: the folder of case files
  std::string side;     ///< left, right, or empty: not given
  std::string runs = "runs", target = "summary";
  int jobs = 1;
  bool plan = false;
  bool slurm = false, local = false;  ///< of cohort: a job array, or processes of this machine
  std::map<std::string, std::string> settings;  ///< given as SETTING=value
};

/// The declaration of `run`, `demo` or `cohort` for help and completion, which stores nothing.
/// Throws Error (failed) for another name.
Declaration pipeline_command(const std::string& name);

/// Throws Error (input) for an unknown option, a word too many, a setting given twice, a side that is missing or contradicted.
PipelineRequest parse_request(const std::string& command,
                              const std::vector<std::string>& arguments);

}  // namespace breast
