// SPDX-License-Identifier: GPL-3.0-or-later
// Forward and backward of mechanics/mechanics.hpp on all ranks of a run. The root rank has the mesh
// and receives the result.
#pragma once

#include "core/progress.hpp"
#include "distributed/ranks.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

/// The options of the root on all ranks, whose own are ignored: only the root reads the file that
/// states the model. Collective.
MechanicsOptions shared_options(const Ranks& ranks, const MechanicsOptions& of_root);

/// Both functions are collective. `mesh` is read on the root only; the arrays of the result are
/// filled on the root only, and its summary on all ranks. The linear solver is always multigrid;
/// there is no search for a remedy and no error estimate. Throws a SharedError (input) if mesh and
/// options do not fit together.
Equilibrium solve_forward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                             const MechanicsOptions& options, Progress& progress);
Equilibrium solve_backward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                              const MechanicsOptions& options, Progress& progress);

}  // namespace breast
