// SPDX-License-Identifier: GPL-3.0-or-later
// Execution of another tool of the installation as part of a tool's work.
#pragma once

#include <string>
#include <vector>

#include "core/report.hpp"

namespace breast {

/// Throws Error (input) if there is no program `tool` in the folder of the running one; `what` is
/// the option that needs it, `packages` what building it needs besides.
void require_sibling(const std::string& tool, const std::string& what, const std::string& packages);

/// Runs the program `tool` from the folder of the running one, without output, and returns its
/// report. The program ends if the caller does. Throws Error with the program's reason (input for
/// bad input, otherwise failed).
Report run_sibling(const std::string& tool, const std::vector<std::string>& arguments);

}  // namespace breast
