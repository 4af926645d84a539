// SPDX-License-Identifier: GPL-3.0-or-later
// Words with which a shell can complete a `breast` command line.
#pragma once

#include <string>
#include <vector>

#include "command/installation.hpp"

namespace breast {

/// Candidates for the last of `words` (the words after `breast`, the last one incomplete), to be
/// filtered by its beginning; empty if a file name is expected. The tools themselves are asked for
/// their options.
std::vector<std::string> completions(const Installation& installation,
                                     const std::vector<std::string>& words);

}  // namespace breast
