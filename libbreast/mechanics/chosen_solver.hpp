// SPDX-License-Identifier: GPL-3.0-or-later
// `--solver auto`: multigrid where it is cheaper and all goes well, else a
// factor, which knows more.
#pragma once

#include <functional>

#include "mechanics/mechanics.hpp"

namespace breast {

/// Solves with options.solver direct or multigrid. `fail_fast`: is to give up at the first
/// difficulty, and wherever the answer is not known to be a stable equilibrium.
using SolveAttempt = std::function<Equilibrium(const MechanicsOptions& options, bool fail_fast)>;

/// What `attempt` returns with the linear solver the options name. With automatic choice,
/// multigrid where the cost model (solve/choose_solver.hpp) expects it to be cheaper; an
/// attempt of it that gave up is followed by a direct solve from the start, where memory
/// allows, and counts in the seconds.
Equilibrium with_chosen_solver(double unknowns, const MechanicsOptions& options,
                               Progress& progress, const SolveAttempt& attempt);

}  // namespace breast
