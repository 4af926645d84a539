// SPDX-License-Identifier: GPL-3.0-or-later
// Words with which a shell can complete a `breast` command line.
#pragma once

#include <string>
#include <vector>

#include "command/installation.hpp"

namespace breast {

/// Candidates for the last of `words` (the words after `breast`, the last one incomplete), not yet
/// filtered by its beginning; empty if a file name is expected. Options are obtained from the tools
/// themselves.
std::vector<std::string> completions(const Installation& installation,
                                     const std::vector<std::string>& words);

}  // namespace breast
