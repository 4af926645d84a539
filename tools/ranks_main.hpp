// SPDX-License-Identifier: GPL-3.0-or-later
// The main function of tools that mpirun starts on several processes: one of them reads, writes and
// speaks, an error of one is an error of all.
#pragma once

#include <functional>

#include "cli/tool.hpp"
#include "distributed/ranks.hpp"

namespace breast {

/// As Tool::main, on all ranks of the run. What `body` throws on one rank outside Ranks::together
/// ends the run on all.
int ranks_main(Tool& tool, int argc, char** argv,
               const std::function<void(Run&, const Ranks&)>& body);

}  // namespace breast
