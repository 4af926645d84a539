// SPDX-License-Identifier: GPL-3.0-or-later
// Forward and backward: the two directions of one discrete equilibrium R(X, x, p) = 0.
#pragma once

#include "core/progress.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

/// The shape under `gravity` (mm/s², LPS) of the body whose stress-free shape is mesh.reference;
/// nodal gravity forces are those of mesh.imaged. Not converged: status says so, no throw; the last
/// good state is returned.
Equilibrium solve_forward(const HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                          Progress& progress = no_progress());

/// The stress-free shape such that the imaged shape is in equilibrium under `gravity`; pressures are
/// those of the imaged state.
Equilibrium solve_backward(const HexMesh& mesh, const Vec3& gravity,
                           const MechanicsOptions& options, Progress& progress = no_progress());

/// The same under any dead nodal forces (µN, 3 per node) instead of gravity, starting from
/// mesh.reference, where held nodes stay.
Equilibrium solve_backward_under(const HexMesh& mesh, const Eigen::VectorXd& forces,
                                 const MechanicsOptions& options,
                                 Progress& progress = no_progress());

/// The same by fixed point, X ← X − (x(X) − x_imaged), one forward solve an iteration (Sellier
/// 2011): slower and less robust, an independent check of solve_backward.
Equilibrium solve_backward_fixed_point(const HexMesh& mesh, const Vec3& gravity,
                                       const MechanicsOptions& options, double tolerance_mm = 1e-8,
                                       int max_iterations = 60,
                                       Progress& progress = no_progress());

/// Writes the equilibrium under the keys of docs/file-formats.md; `mesh` is the one that was solved.
void write_report(const Equilibrium& equilibrium, const HexMesh& mesh,
                  const MechanicsOptions& options, Report& report);

}  // namespace breast
