// SPDX-License-Identifier: GPL-3.0-or-later
// The automatic choice of linear solver (`--solver auto`): multigrid where it is cheaper, followed
// by a direct solve where multigrid meets a difficulty.
#pragma once

#include <functional>

#include "mechanics/mechanics.hpp"

namespace breast {

/// A solve with options.solver direct or multigrid. With `fail_fast` it gives up at the first
/// difficulty, and whenever the result is not known to be a stable equilibrium.
using SolveAttempt = std::function<Equilibrium(const MechanicsOptions& options, bool fail_fast)>;

/// Runs `attempt` with the linear solver of the options. The automatic choice is multigrid where
/// the cost model (solve/choose_solver.hpp) expects it to be cheaper; if that attempt gives up, a
/// direct solve from the start follows, memory permitting, and the time of both counts.
Equilibrium with_chosen_solver(double unknowns, const MechanicsOptions& options, Progress& progress,
                               const SolveAttempt& attempt);

}  // namespace breast
