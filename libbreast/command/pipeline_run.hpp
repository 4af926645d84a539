// SPDX-License-Identifier: GPL-3.0-or-later
// The pipeline as a command: breast run, demo and cohort.
#pragma once

#include <string>
#include <vector>

#include "command/installation.hpp"

namespace breast {

/// Runs `breast COMMAND arguments` (run, demo or cohort). Everything that can be refused is refused
/// first; then make runs in the present folder, and the location of the results is printed. Returns
/// 0, 1 if a stage failed, or 128 + the signal that ended make; throws Error.
int run_pipeline(const Installation& installation, const std::string& command,
                 const std::vector<std::string>& arguments);

/// The settings of the pipeline by name; empty if make fails to list them.
std::vector<std::string> pipeline_settings(const Installation& installation);

/// The pipeline's help on its targets and settings.
std::string settings_help(const Installation& installation);

}  // namespace breast
