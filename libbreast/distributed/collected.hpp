// SPDX-License-Identifier: GPL-3.0-or-later
// What forward and backward over ranks share: their options, and the way from the parts' states to
// the answer of the whole mesh.
#pragma once

#include "distributed/part_problem.hpp"
#include "distributed/part_saddle.hpp"
#include "mechanics/equilibrium.hpp"

namespace breast {

/// The same with the one solver that works over ranks. Throws Error (input) where another is asked for.
MechanicsOptions options_for_ranks(const MechanicsOptions& options);

/// Notes what the linear solver needed, over all ranks; collective.
void note_solver(const PartSaddle& solver, SolveSummary& summary);

/// Fills the arrays of `found` on the root and judges them, see conclude in mechanics/solution.hpp;
/// `mesh` is the whole one, read on the root. Collective.
void conclude_on(const PartProblem& problem, const HexMesh& mesh, const MechanicsOptions& options,
                 const State& own, const Vec3& gravity, Equilibrium& found);

}  // namespace breast
