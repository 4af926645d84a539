// SPDX-License-Identifier: GPL-3.0-or-later
// Forward and backward of mechanics/mechanics.hpp on all ranks of a run. The root has the mesh and
// gets the answer.
#pragma once

#include "core/progress.hpp"
#include "distributed/ranks.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

/// Collective. `mesh` is read, and the arrays of the result are filled, on the root only; its summary
/// on all ranks. Always multigrid; no search for a remedy and no error estimate. Throws a SharedError
/// (input) when mesh and options do not fit.
Equilibrium solve_forward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                             const MechanicsOptions& options, Progress& progress);
Equilibrium solve_backward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                              const MechanicsOptions& options, Progress& progress);

}  // namespace breast
