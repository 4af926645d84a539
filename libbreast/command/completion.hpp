// SPDX-License-Identifier: GPL-3.0-or-later
// Words with which a shell can complete a `breast` command line.
#pragma once

#include <string>
#include <vector>

#include "command/installation.hpp"

namespace breast {

/// Candidates for the last of `words` (what stands after `breast`, the last one incomplete), to be filtered by what it begins with;
/// empty where a file name is wanted. What options a tool has, it is asked itself.
std::vector<std::string> completions(const Installation& installation,
                                     const std::vector<std::string>& words);

}  // namespace breast
