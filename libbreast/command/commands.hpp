// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of `breast` other than the tools.
#pragma once

#include <string>
#include <vector>

#include "cli/declaration.hpp"
#include "command/installation.hpp"

namespace breast {

/// Names of the commands: run, demo, cohort, list, help.
std::vector<std::string> command_names();
bool is_pipeline_command(const std::string& name);

/// The declaration of `breast` itself, for its manual page.
Declaration breast_declaration();

/// Lines of "NAME  summary".
std::string tool_list(const Installation& installation);
/// The output of `breast help`.
std::string overview(const Installation& installation);

/// "'segmnt' is neither a command nor a tool; did you mean 'segment'?", with up to three names.
std::string unknown_command(const Installation& installation, const std::string& given);

}  // namespace breast
