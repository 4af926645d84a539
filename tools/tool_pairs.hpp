// SPDX-License-Identifier: GPL-3.0-or-later
// The check of a tool's pairs of files, and its option --accept-other.
#pragma once

#include <string>

#include "cli/tool.hpp"
#include "lineage/pairs.hpp"

namespace breast {

/// The pairs of this run, whose remarks go to the user and into the report.
inline Pairs pairs_of(const std::string& tool, Run& run, const std::string& accept_other = "") {
  return {tool, [&run](const std::string& remark) { run.remark(remark); }, accept_other};
}

/// Declares --accept-other for a tool with a row of the table that allows it.
inline void declare_accept_other(Tool& tool, const std::string& name, std::string& accept_other) {
  tool.choice(accept_other, "--accept-other", acceptable(name), accept_other_help(name));
}

}  // namespace breast
