// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that forward and backward on several ranks share: their options, and the collection of the
// parts' states into the result for the whole mesh.
#pragma once

#include "distributed/part_problem.hpp"
#include "distributed/part_saddle.hpp"
#include "mechanics/equilibrium.hpp"

namespace breast {

/// `options` with the only linear solver that works on several ranks. Throws Error (input) if
/// another solver is requested.
MechanicsOptions options_for_ranks(const MechanicsOptions& options);

/// Adds the cost of the linear solver, over all ranks, to the summary; collective.
void note_solver(const PartSaddle& solver, SolveSummary& summary);

/// Fills the arrays of `found` on the root and assesses them (see conclude in
/// mechanics/solution.hpp). `mesh` is the whole mesh, which is read on the root only. Collective.
void conclude_on(const PartProblem& problem, const HexMesh& mesh, const MechanicsOptions& options,
                 const State& own, const Vec3& gravity, Equilibrium& found);

}  // namespace breast
