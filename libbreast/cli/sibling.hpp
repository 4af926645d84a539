// SPDX-License-Identifier: GPL-3.0-or-later
// Running another tool of the installation for part of a tool's work.
#pragma once

#include <string>
#include <vector>

#include "core/report.hpp"

namespace breast {

/// Throws Error (input) when no program `tool` stands beside the running one; `what` is the option
/// that needs it.
void require_sibling(const std::string& tool, const std::string& what);

/// Runs the program `tool` that stands beside the running one, silently, and returns its report. It
/// dies with the caller. Throws Error with its reason (input where it says bad input, else failed).
Report run_sibling(const std::string& tool, const std::vector<std::string>& arguments);

}  // namespace breast
