// SPDX-License-Identifier: GPL-3.0-or-later
// The forward and the backward problem: the discrete equilibrium R(X, x, p) = 0 solved for x or for
// X.
#pragma once

#include "core/progress.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

/// The shape under `gravity` (mm/s², LPS) of the body whose stress-free shape is mesh.reference;
/// the nodal gravity forces are those of mesh.imaged. If it does not converge, it does not throw:
/// the last valid state is returned with the appropriate status.
Equilibrium solve_forward(const HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                          Progress& progress = no_progress());

/// The stress-free shape for which the imaged shape is in equilibrium under `gravity`; the
/// pressures are those of the imaged shape.
Equilibrium solve_backward(const HexMesh& mesh, const Vec3& gravity,
                           const MechanicsOptions& options, Progress& progress = no_progress());

/// Writes the equilibrium under the keys of docs/file-formats.md; `mesh` is the one that was solved.
void write_report(const Equilibrium& equilibrium, const HexMesh& mesh,
                  const MechanicsOptions& options, Report& report);

}  // namespace breast
