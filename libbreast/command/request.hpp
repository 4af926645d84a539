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
  std::string scan;     ///< for run a file or folder, for cohort the folder of case files
  std::string side;     ///< left, right, or empty if not given
  std::string runs = "runs", target = "summary";
  int jobs = 1;
  bool plan = false;
  bool slurm = false, local = false;  ///< for cohort: a job array, or processes on this machine
  std::map<std::string, std::string> settings;  ///< given as SETTING=value
};

/// The declaration of `run`, `demo` or `cohort` for help and completion, which stores nothing.
/// Throws Error (failed) for another name.
Declaration pipeline_command(const std::string& name);

/// Throws Error (input) for an unknown option, a superfluous word, a setting given twice, or a side
/// that is missing or contradicted.
PipelineRequest parse_request(const std::string& command,
                              const std::vector<std::string>& arguments);

}  // namespace breast
