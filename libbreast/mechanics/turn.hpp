// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria while gravity turns from one posture to another.
#pragma once

#include <vector>

#include "core/progress.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

/// Gravity at a part (0 to 1) of its way from `from` to `to` (mm/s², LPS): it turns by equal angles
/// in the plane of both, and its size changes evenly. Opposite directions have no such plane: there it
/// turns about the patient's long axis (or, along that axis, about the transverse one), so that the
/// patient rolls over the side of the breast. If one of the two is zero, only the size changes.
Vec3 turned_gravity(const Vec3& from, const Vec3& to, Side side, double part);

/// The equilibria of mesh.reference under turned_gravity at `states` (at least 2) parts of the way, from
/// 0 to 1 in equal steps. Each is solved from the one before it, in smaller steps where that is
/// needed. A state that is not found has the status and the reason of solve_forward and no shape, and
/// the next is sought from the last one that was found.
std::vector<Equilibrium> solve_turn(const HexMesh& mesh, const Vec3& from, const Vec3& to,
                                    int states, const MechanicsOptions& options,
                                    Progress& progress = no_progress());

}  // namespace breast
