// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the forward problem leads from a stress-free shape back to the imaged one.
#pragma once

#include <optional>

#include "mechanics/equilibrium.hpp"

namespace breast {

/// Largest distance from the imaged shape at which a stress-free shape counts as found, mm: a hundred
/// times what rounding leaves.
inline constexpr double closure_bound_mm = 1e-6;

/// Judges `backward` by `again`, the forward solution from its stress-free shape under the gravity of
/// the scan: the closure, which is the largest distance of the nodes of `again` from mesh.imaged, mm;
/// no value if `again` did not converge. Without a closure within the bound, gravity leads from the
/// stress-free shape to another equilibrium than the scan, and so may every other posture: `backward`
/// becomes not converged, with the reason "not_closed".
std::optional<double> judge_closure(const Equilibrium& again, const HexMesh& mesh,
                                    Equilibrium& backward);

}  // namespace breast
