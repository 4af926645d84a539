// SPDX-License-Identifier: GPL-3.0-or-later
// The main function of tools that mpirun starts on several processes: one of them reads, writes and
// prints, and an error of one ends all.
#pragma once

#include <functional>

#include "cli/tool.hpp"
#include "distributed/ranks.hpp"

namespace breast {

/// Runs Tool::main on all ranks. An exception of `body` on one rank outside Ranks::together ends
/// the run on all ranks.
int ranks_main(Tool& tool, int argc, char** argv,
               const std::function<void(Run&, const Ranks&)>& body);

}  // namespace breast
