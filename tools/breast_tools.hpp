// SPDX-License-Identifier: GPL-3.0-or-later
// The tools of this build (generated from tools/CMakeLists.txt and docs/man).
#pragma once

#include <vector>

#include "command/installation.hpp"

namespace breast {

/// In the order of tools/CMakeLists.txt, with the one-line summary of each.
std::vector<ToolEntry> built_tools();

}  // namespace breast
