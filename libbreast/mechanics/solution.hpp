// SPDX-License-Identifier: GPL-3.0-or-later
// The final steps that forward, backward and compress share: from a solved state to an Equilibrium.
#pragma once

#include "mechanics/equilibrium.hpp"
#include "mechanics/scene.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// The reason_id of an unstable equilibrium.
inline constexpr const char* unstable_equilibrium = "unstable_equilibrium";
/// κ/μ that is nearly incompressible, for the check of stability with multigrid.
inline constexpr double nearly_incompressible = 100;

/// Message for a final state whose tangent is not known to be positive definite.
inline constexpr const char* unknown_stability =
    "the last tangent is not known to be positive definite: the equilibrium may be unstable";

/// Records the cost of the linear solver; call it after the last factorisation.
void note_solver(const SaddleSolver& solver, const SaddleMatrix& matrix, SolveSummary& summary);
/// Copies positions, pressures, det F and gravity (mm/s²), and checks them: poorly shaped or
/// overstrained elements, oscillating pressures and wrinkling skin are added to `doubts`. In a
/// backward solve state.x is the imaged shape.
void conclude(Equilibrium& equilibrium, const Scene& scene, const State& state,
              const Vec3& gravity);

}  // namespace breast
